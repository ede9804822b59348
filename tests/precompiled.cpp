// Nothing but the headers that every test reads: tests/CMakeLists.txt has their list.
