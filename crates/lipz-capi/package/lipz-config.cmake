# find_package(lipz): the target lipz::static and, if there is a shared library, lipz::shared.
get_filename_component(lipz_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

if(NOT TARGET lipz::static)
  add_library(lipz::static STATIC IMPORTED)
  set_target_properties(lipz::static PROPERTIES
    IMPORTED_LOCATION "${lipz_prefix}/lib/@STATIC@"
    INTERFACE_INCLUDE_DIRECTORIES "${lipz_prefix}/include")

  if(NOT "@SHARED@" STREQUAL "")
    add_library(lipz::shared SHARED IMPORTED)
    set_target_properties(lipz::shared PROPERTIES
      IMPORTED_LOCATION "${lipz_prefix}/lib/@SHARED@"
      IMPORTED_SONAME "@SONAME@"
      INTERFACE_INCLUDE_DIRECTORIES "${lipz_prefix}/include")
  endif()
endif()

unset(lipz_prefix)
