# Writes OUTPUT, a source file with the commit of SOURCE; an unchanged one is left alone.
execute_process(
  COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12 --exclude=*
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE status
)
if(NOT status EQUAL 0)
  set(commit unknown)
endif()
set(text "namespace cloth\n{\n\nextern const char* const source_commit;\nconst char* const source_commit = \"${commit}\";\n\n}  // namespace cloth\n")
set(before "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} before)
endif()
if(NOT before STREQUAL text)
  file(WRITE ${OUTPUT} "${text}")
endif()
