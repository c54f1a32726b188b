# Rules of `cmake --install`, in six components: the programs, the viewer window, hearth-wrap, the runtime that games
# ship with, the files to build against it, and bindings for other languages. No installed file contains an absolute path: the installation is
# relocatable.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

get_property(programs GLOBAL PROPERTY HEARTH_PROGRAMS)
get_property(exports GLOBAL PROPERTY HEARTH_EXPORTS)
# Builds everything that is installed, without the tests.
add_custom_target(hearth_installed DEPENDS ${programs} ${exports})
if(TARGET hearth_bindings)
  add_dependencies(hearth_installed hearth_bindings)
endif()

# hearth-view is a component of its own: it needs a window system, and machines that cook have none.
set(window_programs ${programs})
list(FILTER window_programs INCLUDE REGEX "^hearth-view$")
list(REMOVE_ITEM programs ${window_programs})
# hearth-wrap is one, too: it is under the GPL, as CGAL is.
set(wrap_programs ${programs})
list(FILTER wrap_programs INCLUDE REGEX "^hearth-wrap$")
list(REMOVE_ITEM programs ${wrap_programs})
if(programs)
  install(TARGETS ${programs} RUNTIME COMPONENT programs)
endif()
if(wrap_programs)
  install(TARGETS ${wrap_programs} RUNTIME COMPONENT wrap)
endif()
if(window_programs)
  # built on demand, so it may not exist
  install(TARGETS ${window_programs} RUNTIME COMPONENT window OPTIONAL)
endif()
if(programs)
  # shell completions and manual pages of the command: see pipelines/command/CMakeLists.txt
  set(manual ${PROJECT_BINARY_DIR}/manual)
  foreach(section 1 5)
    install(DIRECTORY ${manual}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man${section} COMPONENT programs
      FILES_MATCHING PATTERN "*.${section}")
  endforeach()
  install(FILES ${manual}/hearth.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
    RENAME hearth COMPONENT programs)
  install(FILES ${manual}/_hearth DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions COMPONENT programs)
  install(FILES ${manual}/hearth.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
    COMPONENT programs)
endif()
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT programs)

install(TARGETS ${exports} EXPORT hearthTargets
  LIBRARY COMPONENT runtime NAMELINK_COMPONENT development
  ARCHIVE COMPONENT development
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/hearth)
install(FILES runtime/c/hearth.h runtime/c/hearth.hpp runtime/c/hearth_helpers.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/hearth COMPONENT development)
# format_tables.h belongs to no installed library
install(DIRECTORY formats DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/hearth COMPONENT development
  FILES_MATCHING PATTERN "*.h" PATTERN format_tables.h EXCLUDE)
install(FILES formats/FORMAT.md runtime/c/README.md docs/versions.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/development COMPONENT development)
install(DIRECTORY runtime/c/examples DESTINATION ${CMAKE_INSTALL_DOCDIR}/development COMPONENT development)

if(TARGET hearth_bindings)
  get_target_property(bindings hearth_bindings HEARTH_FILES)
  install(FILES ${bindings} DESTINATION ${CMAKE_INSTALL_DATADIR}/hearth/bindings COMPONENT bindings)
  # without libhearth-helpers.so: programs in C link the archive
  install(TARGETS hearth_helpers_shared LIBRARY COMPONENT bindings NAMELINK_SKIP)
  install(FILES docs/bindings.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/bindings COMPONENT bindings)
  install(DIRECTORY runtime/c/bindings/examples DESTINATION ${CMAKE_INSTALL_DOCDIR}/bindings COMPONENT bindings)
endif()

# find_package(hearth CONFIG)
set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/hearth)
set(HEARTH_SHADERS_FOLDER ${CMAKE_INSTALL_DATADIR}/hearth/shaders)
configure_package_config_file(cmake/hearthConfig.cmake.in ${PROJECT_BINARY_DIR}/hearthConfig.cmake
  INSTALL_DESTINATION ${config_folder}
  PATH_VARS CMAKE_INSTALL_BINDIR HEARTH_SHADERS_FOLDER
  NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/hearthConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(EXPORT hearthTargets NAMESPACE hearth:: DESTINATION ${config_folder} COMPONENT development)
install(FILES
    cmake/HearthAddAssets.cmake
    cmake/HearthAddMaterialShaders.cmake
    cmake/HearthCompileShader.cmake
    cmake/compile_shader.cmake
    cmake/hash_shader_sources.cmake
    ${PROJECT_BINARY_DIR}/hearthConfig.cmake
    ${PROJECT_BINARY_DIR}/hearthConfigVersion.cmake
  DESTINATION ${config_folder} COMPONENT development)

# sources of shading, which games compile with their material functions
install(DIRECTORY runtime/shaders DESTINATION ${HEARTH_SHADERS_FOLDER}/runtime COMPONENT development
  FILES_MATCHING PATTERN "*.glsl" PATTERN "*.vert" PATTERN "*.frag")
install(DIRECTORY formats/gpu_shared DESTINATION ${HEARTH_SHADERS_FOLDER}/formats COMPONENT development
  FILES_MATCHING PATTERN "*.h")

# pkg-config: paths relative to the folder of the file itself, so that the installation is relocatable
file(RELATIVE_PATH prefix_from_pkgconfig /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" prefix_from_pkgconfig ${prefix_from_pkgconfig})
foreach(module hearth hearth-helpers)
  configure_file(cmake/${module}.pc.in ${PROJECT_BINARY_DIR}/${module}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${module}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endforeach()
