# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
# One CMake target a folder. Includes are written from the top of the tree: "core/types/scan.hpp".

# What the ThreadSanitizer and the fuzzing builds need, so that they need not build everything.
add_custom_target(thread_tests COMMENT "Tests with label thread")
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

# What a program or a test itself is made of runs once: a third of its compile time is worth more, and under a
# sanitizer, which instruments what the optimiser leaves, a fifth; another fifth when AddressSanitizer's tests are calls
# and not code in every place. Libraries keep the build type's optimisation.
function(topo_runs_once target)
  if(TOPO_SANITIZE)
    target_compile_options(${target} PRIVATE -Og)
    if(TOPO_SANITIZE MATCHES "address" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      target_compile_options(${target} PRIVATE "SHELL:--param asan-instrumentation-with-call-threshold=0")
    endif()
  else()
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
endfunction()

# topo_program(NAME [MEASURED] SOURCES a.cpp ... DEPS target ...): an executable in the build's bin/ folder;
# MEASURED: a benchmark, whose own code is what is timed.
function(topo_program name)
  cmake_parse_arguments(ARG "MEASURED" "" "SOURCES;DEPS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${ARG_DEPS})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
  if(NOT ARG_MEASURED)
    topo_runs_once(${name})
  endif()
endfunction()

# topo_entry(NAME [REAL_TIME [TRIES n]] [TIMEOUT s] [LABELS integration ...] [ENVIRONMENT k=v ...]
#            COMMAND program arguments...)
# One ctest entry. REAL_TIME: it keeps to the real clock, so on_time.py judges it only on a machine that keeps time,
# in up to TRIES (3) of at most TIMEOUT, and nothing else of its kind runs beside it. Under a sanitizer, which makes the
# programs several times as slow, nothing at all does, and what keeps to no clock has four times as long.
# Label `computes`: it waits for nothing, so that it may have what other tests leave of the processors (.ci/run). The unit
# tests of some folders have it by themselves and, their limits being the shortest, twice that time.
set(TOPO_ON_TIME ${CMAKE_CURRENT_LIST_DIR}/../../tests/integration/on_time.py)
function(topo_entry name)
  cmake_parse_arguments(ARG "REAL_TIME" "TIMEOUT;TRIES" "LABELS;ENVIRONMENT;COMMAND" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  if(NOT ARG_TRIES)
    set(ARG_TRIES 3)
  endif()
  if(NOT ARG_LABELS)
    set(ARG_LABELS integration)
  endif()
  set(slower 4)
  if(CMAKE_CURRENT_SOURCE_DIR MATCHES "/tests/unit/(core|bench|sim)")
    list(APPEND ARG_LABELS computes)
    set(slower 8)
  endif()
  if(ARG_REAL_TIME)
    list(PREPEND ARG_COMMAND ${Python3_EXECUTABLE} -B ${TOPO_ON_TIME} --tries ${ARG_TRIES} --limit ${ARG_TIMEOUT})
    math(EXPR ARG_TIMEOUT "${ARG_TRIES} * ${ARG_TIMEOUT} + 30")
  elseif(TOPO_SANITIZE)
    math(EXPR ARG_TIMEOUT "${slower} * ${ARG_TIMEOUT}")
  endif()
  add_test(NAME ${name} COMMAND ${ARG_COMMAND})
  set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${ARG_TIMEOUT}
                       ENVIRONMENT "${ARG_ENVIRONMENT}")
  if(ARG_REAL_TIME)
    set_tests_properties(${name} PROPERTIES SKIP_RETURN_CODE 77 RESOURCE_LOCK clock)
    if(TOPO_SANITIZE)
      set_tests_properties(${name} PROPERTIES RUN_SERIAL ON)
    endif()
  endif()
endfunction()

# topo_test(NAME SOURCES a_test.cpp ... DEPS target ... [LABELS unit ...] [COMMAND program arguments ...]
#           [what topo_entry takes])
# One GoogleTest executable a folder, one ctest entry an executable. Label `thread` puts it into the
# ThreadSanitizer run.
function(topo_test name)
  cmake_parse_arguments(ARG "REAL_TIME" "TIMEOUT;TRIES" "SOURCES;DEPS;LABELS;ENVIRONMENT;COMMAND" ${ARGN})
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
  endif()
  if(NOT ARG_COMMAND)
    set(ARG_COMMAND $<TARGET_FILE:${name}>)
  endif()
  set(real_time)
  if(ARG_REAL_TIME)
    set(real_time REAL_TIME)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${ARG_DEPS} GTest::gmock GTest::gtest_main)
  topo_runs_once(${name})
  topo_entry(${name} ${real_time} TIMEOUT ${ARG_TIMEOUT} TRIES ${ARG_TRIES} LABELS ${ARG_LABELS}
             ENVIRONMENT ${ARG_ENVIRONMENT} COMMAND ${ARG_COMMAND})
  if("thread" IN_LIST ARG_LABELS)
    add_dependencies(thread_tests ${name})
  endif()
endfunction()

# topo_fuzz(NAME SOURCES a_fuzz.cpp ... DEPS target ... [SEEDS folder] [DICTIONARY file] [MUTANTS n])
# A file with LLVMFuzzerTestOneInput. In preset `fuzz` it is linked with libFuzzer and searches for
# TOPO_FUZZ_SECONDS, with the words of the dictionary, under AddressSanitizer and UndefinedBehaviorSanitizer; in builds
# without a sanitizer the same function gets the seeds and MUTANTS (4000) fixed mutants of them.
set(TOPO_FUZZ_SECONDS 10 CACHE STRING "How long each libFuzzer test searches")
set(TOPO_FUZZ_REPLAY ${CMAKE_CURRENT_LIST_DIR}/../../tests/fuzz/replay_main.cpp)
function(topo_fuzz name)
  cmake_parse_arguments(ARG "" "SEEDS;DICTIONARY;MUTANTS" "SOURCES;DEPS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${ARG_DEPS})
  add_dependencies(fuzzers ${name})
  if(TOPO_FUZZ)
    target_link_options(${name} PRIVATE -fsanitize=fuzzer)
    # The first folder takes what is found; the seeds are only read.
    file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/${name}_found)
    set(dictionary)
    if(ARG_DICTIONARY)
      set(dictionary -dict=${ARG_DICTIONARY})
    endif()
    add_test(NAME ${name}
             COMMAND ${name} -max_total_time=${TOPO_FUZZ_SECONDS} -timeout=10 -rss_limit_mb=2048 -print_final_stats=1
                     -seed=1 ${dictionary} ${CMAKE_CURRENT_BINARY_DIR}/${name}_found ${ARG_SEEDS})
  else()
    target_sources(${name} PRIVATE ${TOPO_FUZZ_REPLAY})
    if(NOT ARG_MUTANTS)
      set(ARG_MUTANTS 4000)
    endif()
    add_test(NAME ${name} COMMAND ${name} ${ARG_MUTANTS} ${ARG_SEEDS})
  endif()
  math(EXPR limit_s "${TOPO_FUZZ_SECONDS} + 100")
  set_tests_properties(${name} PROPERTIES LABELS fuzz TIMEOUT ${limit_s})
endfunction()
