# Every package is Debian 12's; script/bootstrap installs them by name.
find_package(Threads REQUIRED)
find_package(Boost 1.81 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(SQLite3 3.40 REQUIRED)
find_package(spdlog 1.10 REQUIRED)
find_package(CLI11 2.1 REQUIRED)
find_package(CURL 7.88 REQUIRED)
find_package(hwy 1.0.3 REQUIRED)
find_package(JPEG REQUIRED)
find_package(OpenSSL 3.0 REQUIRED)
find_package(PNG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(yaml-cpp REQUIRED)
if(HAARMONY_TESTS)
    find_package(GTest 1.12 REQUIRED)
endif()

# OpenImageIO's own CMake package pulls in the development files of every library that it
# was built with; its pkg-config file does not.
find_package(PkgConfig REQUIRED)
pkg_check_modules(OpenImageIO REQUIRED IMPORTED_TARGET OpenImageIO)
pkg_check_modules(XXHash REQUIRED IMPORTED_TARGET libxxhash)
pkg_check_modules(WebP REQUIRED IMPORTED_TARGET libwebp libwebpdemux)
