# `cmake --install`, the core as a library for find_package(Talus), man pages, the site, and Debian packages. All of it
# stands here, beside the rooms: nothing in them knows that it will be installed.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
file(STRINGS CITATION.cff cited REGEX "^version: ")
if(NOT cited STREQUAL "version: ${PROJECT_VERSION}")
  message(FATAL_ERROR "CITATION.cff has '${cited}', the project is of version ${PROJECT_VERSION}")
endif()

# The program, and what it finds beside its own folder (app/system/own_files.hpp).
set(data ${CMAKE_INSTALL_DATADIR}/talus)
install(TARGETS talus RUNTIME COMPONENT talus)
install(DIRECTORY scenarios/ DESTINATION ${data}/scenarios COMPONENT talus
  FILES_MATCHING REGEX "\\.(toml|stl|vtu|LICENSE)$" PATTERN build EXCLUDE)
install(DIRECTORY postprocess/ DESTINATION ${data}/postprocess COMPONENT talus USE_SOURCE_PERMISSIONS
  FILES_MATCHING PATTERN "*.py" REGEX "(viewer/bundle|sweeps/drivers)/" PATTERN __pycache__ EXCLUDE PATTERN node_modules EXCLUDE
  PATTERN pictures EXCLUDE)
install(FILES app/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME talus
  COMPONENT talus)
install(FILES README.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT talus)

# The core: its headers, its rooms as static libraries, and Talus::core, which is all of them.
get_property(rooms DIRECTORY core PROPERTY BUILDSYSTEM_TARGETS)
list(FILTER rooms INCLUDE REGEX "^talus_(core|cgal)")
foreach(room ${rooms})
  string(REPLACE talus_ "" name ${room})
  set_target_properties(${room} PROPERTIES EXPORT_NAME ${name})
endforeach()
target_include_directories(talus_core_base PUBLIC $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/talus>)
target_compile_features(talus_core_base INTERFACE cxx_std_20)
target_link_libraries(talus_core_base INTERFACE
  $<INSTALL_INTERFACE:Eigen3::Eigen> $<INSTALL_INTERFACE:OpenMP::OpenMP_CXX>)
install(TARGETS ${rooms} EXPORT talus ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/talus COMPONENT development)
install(DIRECTORY core DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/talus COMPONENT development
  FILES_MATCHING PATTERN "*.hpp")
set(config ${CMAKE_INSTALL_LIBDIR}/cmake/Talus)
install(EXPORT talus NAMESPACE Talus:: FILE TalusTargets.cmake DESTINATION ${config} COMPONENT development)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/TalusConfig.cmake @ONLY CONTENT [[
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 3.4 NO_MODULE)
find_dependency(OpenMP COMPONENTS CXX)
find_dependency(CGAL 5.5)
include(${CMAKE_CURRENT_LIST_DIR}/TalusTargets.cmake)
]])
write_basic_package_version_file(${PROJECT_BINARY_DIR}/TalusConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/TalusConfig.cmake ${PROJECT_BINARY_DIR}/TalusConfigVersion.cmake
  DESTINATION ${config} COMPONENT development)

# What every target below that runs Python is run with: the one that has Debian's packages.
set(python /usr/bin/python3)

# Manual pages, from what the program says of itself.
set(man ${PROJECT_BINARY_DIR}/man)
add_custom_command(OUTPUT ${man}/talus.1.gz DEPENDS talus app/man_pages.py
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${man}
  COMMAND ${python} ${PROJECT_SOURCE_DIR}/app/man_pages.py $<TARGET_FILE:talus> ${man} VERBATIM)
add_custom_target(man ALL DEPENDS ${man}/talus.1.gz)
install(DIRECTORY ${man}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT talus FILES_MATCHING PATTERN "*.1.gz")
install(DIRECTORY ${man}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man5 COMPONENT talus FILES_MATCHING PATTERN "*.5.gz")

# The site. `docs` first runs the scenes whose pictures it shows, on one thread: some ten minutes, but only once; `site`
# does without those that are not made yet.
set(docs ${PROJECT_BINARY_DIR}/docs)
set(site_sources ${PROJECT_SOURCE_DIR}/app/site)
set(make_pictures
  COMMAND ${python} ${site_sources}/gallery.py $<TARGET_FILE:talus> ${docs}/made/gallery
  COMMAND ${python} ${site_sources}/tutorial.py $<TARGET_FILE:talus> ${docs}/made/tutorial)
set(make_site
  COMMAND ${python} ${site_sources}/assemble.py $<TARGET_FILE:talus> ${docs}/made ${docs}/source
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${docs}/html
  COMMAND ${python} -m sphinx -b html -q -W --keep-going -d ${docs}/doctrees ${docs}/source ${docs}/html
  COMMAND ${CMAKE_COMMAND} -E echo "the site: ${docs}/html/index.html")
add_custom_target(docs ${make_pictures} ${make_site} DEPENDS talus USES_TERMINAL VERBATIM)
add_custom_target(site ${make_site} DEPENDS talus USES_TERMINAL VERBATIM)
install(DIRECTORY ${docs}/html/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/html COMPONENT site OPTIONAL
  PATTERN .buildinfo EXCLUDE PATTERN objects.inv EXCLUDE)

# Debian packages, into packages/ of the build folder: talus, libtalus-dev, and, where the site and the Python module were
# built, talus-doc and python3-talus.
set(maintainer "The authors of Talus <maintainers@talus.invalid>") # no such address: packages for oneself
if(DEFINED ENV{DEBFULLNAME} AND DEFINED ENV{DEBEMAIL}) # as Debian's own tools have it
  set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(TALUS_MAINTAINER "${maintainer}" CACHE STRING "Who answers for the packages")
set(changelog ${PROJECT_BINARY_DIR}/changelog)
configure_file(app/debian/changelog.in ${changelog} @ONLY)
execute_process(COMMAND gzip -9nkf ${changelog} COMMAND_ERROR_IS_FATAL ANY)
foreach(package IN ITEMS "talus;talus" "development;libtalus-dev" "site;talus-doc"
    "python;python3-talus")
  list(GET package 0 component)
  list(GET package 1 name)
  string(TOUPPER ${component} COMPONENT)
  set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME ${name})
  install(FILES app/debian/copyright ${changelog}.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name}
    COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()
set(CPACK_GENERATOR DEB)
set(CPACK_OUTPUT_FILE_PREFIX ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${TALUS_MAINTAINER})
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_TALUS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_TALUS_PACKAGE_DEPENDS "python3:any")
set(CPACK_DEBIAN_TALUS_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/app/debian/prerm)
set(CPACK_DEBIAN_TALUS_PACKAGE_RECOMMENDS "python3-talus, python3-vtk9, python3-numpy, python3-matplotlib, xvfb, xauth")
set(CPACK_DEBIAN_TALUS_PACKAGE_SUGGESTS "talus-doc, paraview, ffmpeg, python3-scipy, python3-sklearn, parallel")
set(CPACK_COMPONENT_TALUS_DESCRIPTION "${PROJECT_DESCRIPTION}
Many spheres in contact with Coulomb friction, stepped with the nonsmooth
discrete element method and solved by projected Gauss-Seidel. A scene is a
TOML file; a run writes frames for ParaView, tables of metrics and a summary
with its errors. The same input gives the same bits for any number of
threads.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev, libcgal-dev, g++")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Granular dynamics: the core as a library
Headers and static libraries of the step of Talus, and what CMake needs to
find them.")
string(REGEX MATCH "^[0-9]+\\.[0-9]+" python_version "${Python3_VERSION}")
math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "talus (= ${PROJECT_VERSION}), python3-numpy, \
python3 (>= ${python_version}), python3 (<< ${Python3_VERSION_MAJOR}.${next_minor})")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-vtk9")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/app/debian/python/prerm)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Granular dynamics: Talus as a Python module
Simulations that a program makes the steps of, between which it reads and
changes them through NumPy; and a reader of what runs left.")
set(CPACK_DEBIAN_SITE_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_SITE_PACKAGE_ARCHITECTURE all)
set(CPACK_COMPONENT_SITE_DESCRIPTION "Granular dynamics: documentation
The site of Talus, to be read from the disk: tutorial, gallery, every key of
a scene, the method, what was measured, limits.")
if(TALUS_PYTHON)
  set(python_component python)
  set(python_module talus_python)
endif()
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_BINARY_DIR}/packages.cmake)
file(CONFIGURE OUTPUT ${CPACK_PROJECT_CONFIG_FILE} CONTENT [[
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # each has its own
set(CPACK_COMPONENTS_ALL talus development @python_component@)
if(EXISTS @docs@/html/index.html)
  list(APPEND CPACK_COMPONENTS_ALL site)
endif()
]] @ONLY)
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
include(CPack)
add_custom_target(deb COMMAND ${CMAKE_CPACK_COMMAND} -G DEB DEPENDS talus man ${rooms} ${python_module} USES_TERMINAL
  VERBATIM)
