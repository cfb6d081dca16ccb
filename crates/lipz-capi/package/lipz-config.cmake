# find_package(lipz): the targets lipz::static and lipz::shared.
get_filename_component(lipz_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

if(NOT TARGET lipz::static)
  add_library(lipz::static STATIC IMPORTED)
  set_target_properties(lipz::static PROPERTIES
    IMPORTED_LOCATION "${lipz_prefix}/lib/liblipz.a"
    INTERFACE_INCLUDE_DIRECTORIES "${lipz_prefix}/include")

  add_library(lipz::shared SHARED IMPORTED)
  set_target_properties(lipz::shared PROPERTIES
    IMPORTED_LOCATION "${lipz_prefix}/lib/@SONAME@"
    IMPORTED_SONAME "@SONAME@"
    INTERFACE_INCLUDE_DIRECTORIES "${lipz_prefix}/include")
endif()

unset(lipz_prefix)
