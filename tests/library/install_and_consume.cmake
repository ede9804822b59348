# cmake -DBUILD=dir -DSOURCE=dir -DWORK=dir -DWAY=package|pkg-config|subdirectory|headers|prefix
#       -DCXX=compiler -DCXX_FLAGS=flags -DGENERATOR=name -DBUILD_TYPE=type -P install_and_consume.cmake
# Installs the build, moves the installed tree (nothing in it may know where it was), and uses it as a stranger would.

cmake_minimum_required(VERSION 3.22)

# run(TEXT COMMAND...): stops with everything the command said when it fails.
function(run text)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${text} failed (${code}): ${ARGN}\n${output}")
  endif()
  message(STATUS "${text}\n${output}")
endfunction()

function(run_consumer folder)
  run("consumer" ${folder}/consumer)
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
set(consumer ${SOURCE}/tests/library/consumer)
set(prefix ${WORK}/moved)
set(configure ${CMAKE_COMMAND} -G ${GENERATOR} -S ${consumer} -B ${WORK}/build -DCMAKE_CXX_COMPILER=${CXX}
              "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}" -DCMAKE_BUILD_TYPE=${BUILD_TYPE})

if(WAY STREQUAL "subdirectory")
  # Configured only: building it again would take as long as the build under test and compile the same files.
  run("configure as a subdirectory" ${configure} -DHALFFRAME_SOURCE=${SOURCE})
  if(EXISTS ${WORK}/build/halfframe/tests)
    message(FATAL_ERROR "a subdirectory brought its tests along")
  endif()
  return()
endif()

run("install" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/installed)
file(RENAME ${WORK}/installed ${prefix})

if(WAY STREQUAL "package")
  run("configure" ${configure} -DCMAKE_PREFIX_PATH=${prefix})
  run("build" ${CMAKE_COMMAND} --build ${WORK}/build)
  run_consumer(${WORK}/build)

elseif(WAY STREQUAL "pkg-config")
  foreach(tool make pkg-config)
    find_program(path_of_${tool} ${tool})
    if(NOT path_of_${tool})
      message(STATUS "skipped: ${tool} is not there; install the Debian package ${tool}")
      return()
    endif()
  endforeach()
  file(GLOB_RECURSE description ${prefix}/halfframe.pc)
  get_filename_component(folder "${description}" DIRECTORY)
  file(COPY ${consumer} DESTINATION ${WORK})
  run("make" ${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${folder} CXX=${CXX} "CXXFLAGS=${CXX_FLAGS}" make -C ${WORK}/consumer)
  run_consumer(${WORK}/consumer)

elseif(WAY STREQUAL "headers")
  # Each installed header compiles alone, with no include path but the prefix: none is missing from the list.
  file(GLOB_RECURSE headers RELATIVE ${prefix}/include/halfframe ${prefix}/include/halfframe/*.h)
  list(LENGTH headers count)
  if(count LESS 10)
    message(FATAL_ERROR "only ${count} headers are installed")
  endif()
  foreach(header IN LISTS headers)
    file(WRITE ${WORK}/one.cpp "#include \"${header}\"\n")
    run(${header} ${CXX} -std=c++20 -fsyntax-only -I${prefix}/include/halfframe ${WORK}/one.cpp)
  endforeach()

elseif(WAY STREQUAL "prefix")
  foreach(pattern "LICENSE" "README.md" "CHANGELOG.md" "es2-minimum.json" "ps3_30fps.json" "halfframeConfigVersion.cmake"
                  "entry_points.inl")
    file(GLOB_RECURSE found ${prefix}/${pattern})
    if(NOT found)
      message(FATAL_ERROR "${pattern} is not installed")
    endif()
  endforeach()
  # No text file of the prefix names the source or the build folder.
  file(GLOB_RECURSE texts ${prefix}/*.cmake ${prefix}/*.pc ${prefix}/*.h ${prefix}/*.inl ${prefix}/*.json)
  foreach(text IN LISTS texts)
    file(READ ${text} content)
    foreach(folder ${SOURCE} ${BUILD} ${WORK})
      string(FIND "${content}" "${folder}" at)
      if(NOT at EQUAL -1)
        message(FATAL_ERROR "${text} names ${folder}: an installed tree must not need it")
      endif()
    endforeach()
  endforeach()
  if(EXISTS ${prefix}/bin/halfframe)
    run("the installed command" ${prefix}/bin/halfframe effects)
  endif()

else()
  message(FATAL_ERROR "no way is called '${WAY}'")
endif()
