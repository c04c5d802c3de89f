# Functions that turn the folders of src/vispline into targets.
include(GNUInstallDirs)
set_property(GLOBAL PROPERTY VISPLINE_FOLDERS "")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

add_library(vispline_flags INTERFACE)
# The same bytes on every machine: no contraction to FMA, no fast math, no -march.
target_compile_options(vispline_flags INTERFACE
  -Wall -Wextra -Wshadow -Wnon-virtual-dtor -ffp-contract=off -fstack-protector-strong
  $<$<BOOL:${VISPLINE_WERROR}>:-Werror>
  # g++ 12 warns of overlapping copies in `"text" + string` where there are none (GCC bug 105651, mended in 13).
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>)
target_compile_definitions(vispline_flags INTERFACE _GLIBCXX_ASSERTIONS)

# vispline_folder(name DEPS <folders or targets> [PRIVATE <targets>]): library vispline_<name> from src/vispline/<name>.
function(vispline_folder name)
  cmake_parse_arguments(ARG "" "" "DEPS;PRIVATE" ${ARGN})
  set(dir ${PROJECT_SOURCE_DIR}/src/vispline/${name})
  if(NOT IS_DIRECTORY ${dir})
    return()
  endif()
  file(GLOB sources CONFIGURE_DEPENDS ${dir}/*.cc)
  list(FILTER sources EXCLUDE REGEX "_test\\.cc$")
  if(sources)
    add_library(vispline_${name} STATIC ${sources})
    set(scope PUBLIC)
    target_link_libraries(vispline_${name} PRIVATE $<BUILD_INTERFACE:vispline_flags> ${ARG_PRIVATE})
  else()
    add_library(vispline_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  foreach(dep IN LISTS ARG_DEPS)
    if(TARGET vispline_${dep})
      target_link_libraries(vispline_${name} ${scope} vispline_${dep})
    else()
      target_link_libraries(vispline_${name} ${scope} ${dep})
    endif()
  endforeach()
  target_include_directories(vispline_${name} ${scope}
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(vispline_${name} ${scope} cxx_std_20)
  set_target_properties(vispline_${name} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY VISPLINE_FOLDERS ${name})
endfunction()

# vispline::vispline, all folders in one, installed with a package file for find_package(vispline).
function(vispline_library)
  get_property(folders GLOBAL PROPERTY VISPLINE_FOLDERS)
  list(TRANSFORM folders PREPEND vispline_ OUTPUT_VARIABLE targets)
  add_library(vispline INTERFACE)
  add_library(vispline::vispline ALIAS vispline)
  target_link_libraries(vispline INTERFACE ${targets})
  install(TARGETS vispline ${targets} EXPORT vispline)
  install(EXPORT vispline NAMESPACE vispline:: FILE vispline-targets.cmake
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vispline)
  include(CMakePackageConfigHelpers)
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/vispline-config-version.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/vispline-config.cmake ${PROJECT_BINARY_DIR}/vispline-config-version.cmake
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vispline)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/vispline DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
          FILES_MATCHING PATTERN "*.h" PATTERN "*_testing.h" EXCLUDE)
endfunction()

# One test program per folder, from the *_test.cc beside the sources.
function(vispline_tests)
  include(GoogleTest)
  get_property(folders GLOBAL PROPERTY VISPLINE_FOLDERS)
  foreach(folder IN LISTS folders)
    file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/vispline/${folder}/*_test.cc)
    if(sources)
      vispline_test(${folder}_test ${sources})
      # Any test may walk along an analytic trajectory.
      target_link_libraries(${folder}_test PRIVATE vispline_${folder} vispline_trajectory)
    endif()
  endforeach()
endfunction()

# vispline_test(name sources...): a GoogleTest program that ctest knows case by case.
function(vispline_test name)
  add_executable(${name} ${ARGN})
  # CERES include path only: ceres::Jet is header-only and the solver is not linked into unit tests.
  target_include_directories(${name} SYSTEM PRIVATE $<TARGET_PROPERTY:Ceres::ceres,INTERFACE_INCLUDE_DIRECTORIES>)
  target_link_libraries(${name} PRIVATE vispline_flags GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE VISPLINE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  # What is tested keeps its optimisation; the tests themselves compile in two thirds of the time.
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 120 PROPERTIES TIMEOUT 600)
endfunction()
