# Sets HEARTH_COOKERS to the cookers that pipelines/cookers/registry.cpp declares, those aside that
# live in pipelines/, import, link and probe, and wrap, which needs CGAL: each has a folder in cook/, and a description pipelines/cookers/NAME.cpp.
set(registry ${PROJECT_SOURCE_DIR}/pipelines/cookers/registry.cpp)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${registry})
file(STRINGS ${registry} HEARTH_COOKERS REGEX "^Cooker describe[A-Za-z]+\\(\\);$")
list(TRANSFORM HEARTH_COOKERS REPLACE "^Cooker describe([A-Za-z]+).*" "\\1")
list(TRANSFORM HEARTH_COOKERS TOLOWER)
list(REMOVE_ITEM HEARTH_COOKERS import link probe wrap)
