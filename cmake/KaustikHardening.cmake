# What makes an error of memory hard to exploit, for every target that links kaustik_options. tests/scripts/hardening_test.py
# reads it off the built files. docs/decisions/056-hardened-and-reproducible.md says what it costs.
include(CheckCXXCompilerFlag)

# Position-independent programs are loaded at random addresses. Modules are position-independent by themselves.
set(type $<TARGET_PROPERTY:TYPE>)
target_compile_options(kaustik_options INTERFACE $<$<NOT:$<STREQUAL:${type},MODULE_LIBRARY>>:-fPIE>)
target_link_options(kaustik_options INTERFACE $<$<STREQUAL:${type},EXECUTABLE>:-pie>)

# Full RELRO: the tables of the loader are filled at the start and read-only from then on. No stack can be executed, and
# no page of code is written by the loader.
target_link_options(kaustik_options INTERFACE LINKER:-z,relro,-z,now,-z,noexecstack,-z,text)

# Canaries: in every function that has an array or the address of a variable, but in the layers between scene and picture
# (KAUSTIK_INNER_LAYER), whose functions run once a ray, only in those that have an array of characters. Not -fcf-protection:
# the linker drops its mark, since start files of Debian 12 lack it, and the marks of indirect jumps then protect nothing.
target_compile_options(kaustik_options INTERFACE
  $<IF:$<BOOL:$<TARGET_PROPERTY:KAUSTIK_INNER_LAYER>>,-fstack-protector,-fstack-protector-strong>)

# Frames touch each page of the stack that they take.
check_cxx_compiler_flag(-fstack-clash-protection KAUSTIK_HAS_STACK_CLASH_PROTECTION)
if(KAUSTIK_HAS_STACK_CLASH_PROTECTION)
  target_compile_options(kaustik_options INTERFACE -fstack-clash-protection)
endif()

# The C library checks the bounds of buffers whose size the optimiser knows. It refuses to without optimisation.
target_compile_options(kaustik_options INTERFACE $<$<NOT:$<CONFIG:Debug>>:-U_FORTIFY_SOURCE>
  $<$<NOT:$<CONFIG:Debug>>:-D_FORTIFY_SOURCE=3>)
