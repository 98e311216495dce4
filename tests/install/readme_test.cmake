# README.md shows example.cpp, whole and as it is: what is shown is what is compiled and run.
file(READ ${PROJECT_DIR}/README.md readme)
file(READ ${SOURCE_DIR}/example.cpp example)
string(FIND "${readme}" "```cpp\n${example}```\n" position)
if(position EQUAL -1)
  message(FATAL_ERROR "README.md has no code block (```cpp) that is tests/install/example.cpp character by character")
endif()
