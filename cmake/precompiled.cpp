// Nothing but the headers that every library reads: cmake/halfframe_target.cmake has their list.
