# Writes OUTPUT: the bytes of FILES (NAME;FILE;NAME;FILE ...) as the texts that HEADER declares in NAMESPACE.
set(text "#include \"${HEADER}\"\n\nnamespace ${NAMESPACE} {\n\nnamespace {\n\n")
set(views "")
while(FILES)
  list(POP_FRONT FILES name file)
  file(READ ${file} bytes HEX)
  # 20 bytes a line, so that editors and compilers stay quick.
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${bytes}")
  string(APPEND text "const char k_${name}[] = {${bytes}};\n\n")
  string(APPEND views "const std::string_view ${name}(k_${name}, sizeof k_${name});\n")
endwhile()
file(WRITE ${OUTPUT} "${text}}  // namespace\n\n${views}\n}  // namespace ${NAMESPACE}\n")
