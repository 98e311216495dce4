# VISORDER_SANITIZE: a list for -fsanitize, such as "address,undefined" or "thread"; empty for none.
set(VISORDER_SANITIZE "" CACHE STRING "Sanitizers to build with")
if(VISORDER_SANITIZE)
  add_compile_options(-fsanitize=${VISORDER_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${VISORDER_SANITIZE})
endif()
