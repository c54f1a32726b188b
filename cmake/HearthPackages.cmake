# Debian packages of the components that HearthInstall.cmake installs: `cpack -G DEB` in the build folder.
get_target_property(abi hearth_runtime SOVERSION)

set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR Hearth)
set(CPACK_PACKAGE_CONTACT "The maintainers of Hearth") # a package must name somebody
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL programs runtime development)
if(window_programs)
  list(APPEND CPACK_COMPONENTS_ALL window)
endif()
if(wrap_programs)
  list(APPEND CPACK_COMPONENTS_ALL wrap)
endif()
if(TARGET hearth_bindings)
  list(APPEND CPACK_COMPONENTS_ALL bindings)
endif()
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)

# dpkg-shlibdeps finds linked libraries; libraries that programs open by name are listed here.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY >=)

set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME hearth)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS libvulkan1)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS "mesa-vulkan-drivers, libcurl4") # libcurl: caches on servers
set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION "Cooks 3D assets into packs, and draws them without a window")

set(CPACK_DEBIAN_WINDOW_PACKAGE_NAME hearth-view)
set(CPACK_DEBIAN_WINDOW_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_WINDOW_PACKAGE_RECOMMENDS mesa-vulkan-drivers)
set(CPACK_COMPONENT_WINDOW_DESCRIPTION "Flies through packs of Hearth in a window")

set(CPACK_DEBIAN_WRAP_PACKAGE_NAME hearth-wrap)
set(CPACK_DEBIAN_WRAP_PACKAGE_SECTION graphics)
set(CPACK_COMPONENT_WRAP_DESCRIPTION "Wraps meshes into watertight ones for Hearth; under the GPL-3, as CGAL is")

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME libhearth${abi})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "Draws packs of Hearth: the library that games ship with")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libhearth-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libhearth${abi} (= ${PROJECT_VERSION}), libvulkan-dev, libxxhash-dev, libzstd-dev")
# hearth_add_assets() runs hearth, hearth_add_material_shaders() the others
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS "hearth, glslc, spirv-tools")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Headers, archives and CMake package of Hearth's runtime and of its pack reader")

set(CPACK_DEBIAN_BINDINGS_PACKAGE_NAME hearth-bindings)
set(CPACK_DEBIAN_BINDINGS_PACKAGE_SECTION devel)
set(CPACK_DEBIAN_BINDINGS_PACKAGE_DEPENDS "libhearth${abi} (= ${PROJECT_VERSION}), libvulkan1")
set(CPACK_DEBIAN_BINDINGS_PACKAGE_SUGGESTS "python3, mono-mcs")
set(CPACK_COMPONENT_BINDINGS_DESCRIPTION "Bindings of Hearth's runtime for Python and C#, and its helpers as a shared library")

include(CPack)
