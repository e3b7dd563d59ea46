# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
# cmake -D FOLDER=page -D FILES=a;b -D OUTPUT=x.cpp -P embed_page.cmake: the files as a table of C++.
set(text "// Made by embed_page.cmake.\n#include <array>\n\n#include \"daemon/view/page.hpp\"\n\nnamespace topo::daemon {\nnamespace {\n\n")
set(rows)
set(count 0)
foreach(name IN LISTS FILES)
  file(READ ${FOLDER}/${name} bytes HEX)
  string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${bytes}")
  string(APPEND text "constexpr char kFile${count}[] = {${bytes}};\n")
  string(APPEND rows "    {\"${name}\", {kFile${count}, sizeof kFile${count}}},\n")
  math(EXPR count "${count} + 1")
endforeach()
string(APPEND text "constexpr std::array<PageFile, ${count}> kFiles{{\n${rows}}};\n\n}  // namespace\n\n"
       "std::span<const PageFile> page_files() { return kFiles; }\n\n}  // namespace topo::daemon\n")
file(WRITE ${OUTPUT} "${text}")
