# Installs the library with its headers, and what find_package(visorder) needs.
include(CMakePackageConfigHelpers)

set(visorder_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/visorder)

# CGAL is headers only, but a static library leaves linking the numbers that CGAL computes with to the program.
target_link_libraries(visorder PRIVATE $<INSTALL_INTERFACE:mpfr> $<INSTALL_INTERFACE:gmp>)

install(TARGETS visorder EXPORT visorder-targets)
install(EXPORT visorder-targets FILE visorderTargets.cmake NAMESPACE visorder:: DESTINATION ${visorder_package_dir})

install(DIRECTORY include/visorder DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES ${PROJECT_BINARY_DIR}/generated/visorder/version.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/visorder)

get_target_property(visorder_library_type visorder TYPE)
# VTK's components are what its targets are named after.
get_target_property(visorder_vtk_components visorder LINK_LIBRARIES)
list(FILTER visorder_vtk_components INCLUDE REGEX "^VTK::")
list(TRANSFORM visorder_vtk_components REPLACE "^VTK::" "")
list(JOIN visorder_vtk_components " " visorder_vtk_components)
configure_package_config_file(cmake/visorderConfig.cmake.in visorderConfig.cmake
  INSTALL_DESTINATION ${visorder_package_dir})
write_basic_package_version_file(visorderConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/visorderConfig.cmake ${PROJECT_BINARY_DIR}/visorderConfigVersion.cmake
  DESTINATION ${visorder_package_dir})
