# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0

# Outside libraries, all of them Debian packages (packages.txt says why each is there). Nothing is downloaded.
find_package(fmt REQUIRED)
find_package(tl-expected REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Eigen3 REQUIRED)
find_package(TBB REQUIRED)
find_library(GEOGRAPHICLIB_LIBRARY NAMES GeographicLib Geographic REQUIRED)
find_package(embree 3 REQUIRED)
# Debian's packages of single modules of OpenCV bring no OpenCVConfig.cmake.
find_path(OPENCV_INCLUDE_DIR NAMES opencv2/imgproc.hpp PATH_SUFFIXES opencv4 REQUIRED)
find_library(OPENCV_CORE_LIBRARY NAMES opencv_core REQUIRED)
find_library(OPENCV_IMGPROC_LIBRARY NAMES opencv_imgproc REQUIRED)
find_package(CLI11 REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo)
pkg_check_modules(LIBPCAP REQUIRED IMPORTED_TARGET libpcap)
pkg_check_modules(TOMLPLUSPLUS REQUIRED IMPORTED_TARGET tomlplusplus)
pkg_check_modules(LIBLZ4 REQUIRED IMPORTED_TARGET liblz4)
pkg_check_modules(LIBZSTD REQUIRED IMPORTED_TARGET libzstd)
find_package(SQLite3 REQUIRED)
find_package(BZip2 REQUIRED)
find_package(Threads REQUIRED)

if(VERGE_DEVELOPER_MODE)
  include(GoogleTest)
  find_package(GTest REQUIRED)
  find_package(benchmark REQUIRED)
  find_package(rapidcheck REQUIRED)
endif()
