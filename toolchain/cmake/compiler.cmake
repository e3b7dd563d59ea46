# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
# Compiler options that hold for every target of the tree. Sanitizers are set here and nowhere else: a
# sanitizer that instruments the test but not the library under test sees almost nothing.

add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion $<$<COMPILE_LANGUAGE:CXX>:-Wold-style-cast>
                    $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor> $<$<COMPILE_LANGUAGE:CXX>:-Woverloaded-virtual> -Wcast-align -Wdouble-promotion
                    -Wformat=2 -Wimplicit-fallthrough)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-Wsuggest-override> -Wduplicated-cond -Wlogical-op)
  if(CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # g++ 12 sees overlaps and overflows inside its own std::string and std::vector at -O3 (GCC bugs 105651 and
    # 107852), and uses after the release of a counted reference. The sanitizer runs see the real ones.
    add_compile_options(-Wno-restrict -Wno-stringop-overflow -Wno-use-after-free)
  endif()
elseif(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  # GUARDED_BY and its kin: g++ parses and ignores them.
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-Wsuggest-override> -Wthread-safety)
endif()
if(TOPO_WERROR)
  add_compile_options(-Werror)
endif()

# The same input must give the same bytes on one machine type (DESIGN "SLAM"): no contraction that depends
# on what the compiler inlined.
add_compile_options(-ffp-contract=off)

# Bounds of containers and emptiness of optionals are checked wherever we look for bugs.
add_compile_definitions($<$<CONFIG:Debug>:_GLIBCXX_ASSERTIONS>)

# Fuzzing is a build of its own (preset `fuzz`): every target gets coverage and sanitizers, tests/fuzz the
# fuzzing engine on top.
if(TOPO_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "TOPO_FUZZ needs clang++ (libFuzzer), found ${CMAKE_CXX_COMPILER_ID}: use preset fuzz")
  endif()
  set(TOPO_SANITIZE address,undefined)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

if(TOPO_SANITIZE)
  add_compile_options(-fsanitize=${TOPO_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${TOPO_SANITIZE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_link_options(-fuse-ld=gold)  # half the time of each link, of which there are a hundred
  endif()
  if(TOPO_SANITIZE MATCHES "undefined" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # A test of every pointer at every use: a third of the compile time. AddressSanitizer sees a null pointer that is
    # used, and the fuzzers' build by clang has both tests where bytes from outside are read.
    add_compile_options(-fno-sanitize=null,alignment)
  endif()
endif()

find_program(TOPO_CCACHE ccache)
if(TOPO_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${TOPO_CCACHE})
endif()
