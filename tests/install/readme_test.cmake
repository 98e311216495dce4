# README.md shows the examples, whole and as they are: what is shown is what is compiled and run.
file(READ ${PROJECT_DIR}/README.md readme)
foreach(name example render_example)
  file(READ ${SOURCE_DIR}/${name}.cpp example)
  string(FIND "${readme}" "```cpp\n${example}```\n" position)
  if(position EQUAL -1)
    message(FATAL_ERROR "README.md has no code block (```cpp) that is tests/install/${name}.cpp character by character")
  endif()
endforeach()
