# Installs BUILD_DIR into an empty WORK_DIR, builds the examples of SOURCE_DIR against what was installed in the way a user
# of the library would, and runs them.
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nreturned ${result}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/prefix)

# Nothing but the public headers.
file(GLOB_RECURSE headers RELATIVE ${WORK_DIR}/prefix ${WORK_DIR}/prefix/*.h)
foreach(header IN LISTS headers)
  if(NOT header MATCHES "^include/visorder/[a-z_]+\\.h$")
    message(FATAL_ERROR "${header} is installed, and is no public header")
  endif()
endforeach()

# What is installed may be moved, and the sources and the build may go.
file(GLOB_RECURSE package_files ${WORK_DIR}/prefix/*.cmake)
foreach(file IN LISTS package_files)
  file(READ ${file} text)
  foreach(folder ${PROJECT_DIR} ${BUILD_DIR} ${WORK_DIR})
    string(FIND "${text}" "${folder}" position)
    if(NOT position EQUAL -1)
      message(FATAL_ERROR "${file} mentions ${folder}")
    endif()
  endforeach()
endforeach()

file(COPY_FILE ${SOURCE_DIR}/consumer.cmake.in ${WORK_DIR}/CMakeLists.txt)
file(COPY_FILE ${SOURCE_DIR}/example.cpp ${WORK_DIR}/example.cpp)
file(COPY_FILE ${SOURCE_DIR}/render_example.cpp ${WORK_DIR}/render_example.cpp)
run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${WORK_DIR} -B ${WORK_DIR}/build -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix)
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build)
run(${WORK_DIR}/build/consumer)
if(NOT output STREQUAL "cell 2\ncell 0\ncell 1\n")
  message(FATAL_ERROR "the example prints:\n${output}")
endif()
run(${WORK_DIR}/build/render)
if(NOT output MATCHES "^the volume covers [1-9][0-9] % of the picture\n$")
  message(FATAL_ERROR "the example that renders prints:\n${output}")
endif()
