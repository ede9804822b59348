# What `cmake --install` puts where: three libraries with their headers, the command, the data files, and the two ways to
# find them (find_package and pkg-config). Everything is relative to the prefix, so an installed tree may be moved.
option(HALFFRAME_INSTALL "Make the install rules" ${PROJECT_IS_TOP_LEVEL})
if(NOT HALFFRAME_INSTALL)
  return()
endif()
include(CMakePackageConfigHelpers)

# The headers a program may include; all others are private. Folders stay as they are: engine/frame/renderer.h is
# include/halfframe/engine/frame/renderer.h, and is included under the same name as inside the project.
set(HALFFRAME_PUBLIC_HEADERS
  engine/error.h
  engine/frame/budget.h
  engine/frame/cost_table.h
  engine/frame/draw_state.h
  engine/frame/early_flush.h
  engine/frame/effect_card.h
  engine/frame/facing.h
  engine/frame/frame_plan.h
  engine/frame/image.h
  engine/frame/motion.h
  engine/frame/pass_timer.h
  engine/frame/moving_meshes.h
  engine/frame/pose.h
  engine/frame/renderer.h
  engine/frame/scene.h
  engine/frame/skinning.h
  engine/frame/texture_storage.h
  engine/frame/tier.h
  engine/frame/uploads.h
  engine/frame/vertex_layout.h
  engine/frame/vertex_storage.h
  engine/gl/call_ledger.h
  engine/gl/caps.h
  engine/gl/entry_points.h
  engine/gl/entry_points.inl
  engine/gl/object.h
  engine/gl/pixel_format.h
  engine/gl/program.h
  platform/context.h
  content/content.h)
foreach(header IN LISTS HALFFRAME_PUBLIC_HEADERS)
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${PROJECT_SOURCE_DIR}/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/halfframe/${folder})
endforeach()

install(TARGETS halfframe_engine halfframe_platform halfframe_content EXPORT halfframe
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
if(TARGET halfframe_command)
  install(TARGETS halfframe_command RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/halfframe)
set(HALFFRAME_DATA_FOLDER ${CMAKE_INSTALL_DATADIR}/halfframe)
install(EXPORT halfframe FILE halfframeTargets.cmake NAMESPACE halfframe:: DESTINATION ${package_folder})
configure_package_config_file(
  ${PROJECT_SOURCE_DIR}/cmake/halfframeConfig.cmake.in ${PROJECT_BINARY_DIR}/package/halfframeConfig.cmake
  INSTALL_DESTINATION ${package_folder} PATH_VARS HALFFRAME_DATA_FOLDER)
# Until 1.0 a new minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/halfframeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/package/halfframeConfig.cmake
              ${PROJECT_BINARY_DIR}/package/halfframeConfigVersion.cmake DESTINATION ${package_folder})

# From the .pc file's folder to the prefix: "../.." or, with Debian's lib/x86_64-linux-gnu, "../../..".
file(RELATIVE_PATH HALFFRAME_PREFIX_FROM_PC "/prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/prefix")
list(TRANSFORM CMAKE_DL_LIBS PREPEND -l OUTPUT_VARIABLE HALFFRAME_DL_FLAGS)
configure_file(${PROJECT_SOURCE_DIR}/cmake/halfframe.pc.in ${PROJECT_BINARY_DIR}/package/halfframe.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/package/halfframe.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

# The library and the command hold the data files already; these are to read and to start one's own from.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/content/budgets ${PROJECT_SOURCE_DIR}/content/check
                  ${PROJECT_SOURCE_DIR}/content/devices
        DESTINATION ${HALFFRAME_DATA_FOLDER} FILES_MATCHING PATTERN "*.json")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR})
