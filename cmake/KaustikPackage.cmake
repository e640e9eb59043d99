# `cpack -G DEB --config build/release/CPackConfig.cmake` packs what `cmake --install` installs. The dependencies are those
# that dpkg-shlibdeps finds for the program and for the library that it loads.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME kaustik)
set(CPACK_PACKAGE_CONTACT "The kaustik authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "photon-mapping batch renderer")
set(CPACK_PACKAGE_DESCRIPTION "kaustik renders scenes with caustics, direct and indirect light from the command line.
 It reads pbrt, glTF and OBJ scenes and writes EXR, PNG and JPEG pictures.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
include(CPack)
