# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
# One CMake target a folder. Includes are written from the top of the tree: "core/types/scan.hpp".

# What the ThreadSanitizer and the fuzzing builds need, so that they need not build everything.
add_custom_target(thread_tests COMMENT "Tests with label thread, and all programs")
add_custom_target(fuzzers COMMENT "What topo_fuzz() made")

# topo_library(NAME [SOURCES a.cpp ...] [DEPS target ...])
# A static library topo_NAME; without SOURCES an interface library of headers.
function(topo_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS" ${ARGN})
  if(ARG_SOURCES)
    add_library(topo_${name} STATIC ${ARG_SOURCES})
    set(scope PUBLIC)
  else()
    add_library(topo_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_include_directories(topo_${name} ${scope} ${PROJECT_SOURCE_DIR})
  target_link_libraries(topo_${name} ${scope} ${ARG_DEPS})
endfunction()

# topo_program(NAME SOURCES a.cpp ... DEPS target ...): an executable in the build's bin/ folder.
function(topo_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${ARG_DEPS})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
  add_dependencies(thread_tests ${name})
endfunction()

# topo_test(NAME SOURCES a_test.cpp ... DEPS target ... [LABELS unit ...] [TIMEOUT s] [ENVIRONMENT k=v ...]
#           [COMMAND program arguments ...])
# One GoogleTest executable a folder, one ctest entry an executable. Label `thread` puts it into the
# ThreadSanitizer run.
function(topo_test name)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;DEPS;LABELS;ENVIRONMENT;COMMAND" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${ARG_DEPS} GTest::gmock GTest::gtest_main)
  # What a test is made of runs once: a third of its compile time is worth more. The libraries stay as packaged.
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  if(NOT ARG_COMMAND)
    set(ARG_COMMAND ${name})
  endif()
  add_test(NAME ${name} COMMAND ${ARG_COMMAND})
  set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${ARG_TIMEOUT}
                       ENVIRONMENT "${ARG_ENVIRONMENT}")
  if("thread" IN_LIST ARG_LABELS)
    add_dependencies(thread_tests ${name})
  endif()
endfunction()

# topo_fuzz(NAME SOURCES a_fuzz.cpp ... DEPS target ... [SEEDS folder])
# A file with LLVMFuzzerTestOneInput. In preset `fuzz` it is linked with libFuzzer and searches for
# TOPO_FUZZ_SECONDS; in every other build the same function gets the seeds and fixed mutants of them, so that
# each run of the tests, with and without sanitizers, goes over it.
set(TOPO_FUZZ_SECONDS 20 CACHE STRING "How long each libFuzzer test searches")
set(TOPO_FUZZ_REPLAY ${CMAKE_CURRENT_LIST_DIR}/../../tests/fuzz/replay_main.cpp)
function(topo_fuzz name)
  cmake_parse_arguments(ARG "" "SEEDS" "SOURCES;DEPS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${ARG_DEPS})
  add_dependencies(fuzzers ${name})
  if(TOPO_FUZZ)
    target_link_options(${name} PRIVATE -fsanitize=fuzzer)
    # The first folder takes what is found; the seeds are only read.
    file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/${name}_found)
    add_test(NAME ${name}
             COMMAND ${name} -max_total_time=${TOPO_FUZZ_SECONDS} -timeout=10 -rss_limit_mb=2048 -print_final_stats=1
                     -seed=1 ${CMAKE_CURRENT_BINARY_DIR}/${name}_found ${ARG_SEEDS})
  else()
    target_sources(${name} PRIVATE ${TOPO_FUZZ_REPLAY})
    add_test(NAME ${name} COMMAND ${name} ${ARG_SEEDS})
  endif()
  math(EXPR limit_s "${TOPO_FUZZ_SECONDS} + 100")
  set_tests_properties(${name} PROPERTIES LABELS fuzz TIMEOUT ${limit_s})
endfunction()
