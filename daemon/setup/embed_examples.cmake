# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
# cmake -D P3DX=p3dx.toml -D P3AT=p3at.toml -D OUTPUT=x.cpp -P embed_examples.cmake: the files as C++.
set(text "// Made by embed_examples.cmake.\n#include \"daemon/setup/templates.hpp\"\n\nnamespace topo::daemon {\n")
foreach(model P3dx P3at)
  string(TOUPPER ${model} variable)
  file(READ ${${variable}} bytes HEX)
  string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${bytes}")
  string(APPEND text "namespace {\nconstexpr char kBytes${model}[] = {${bytes}};\n}\n"
         "const std::string_view kExample${model}{kBytes${model}, sizeof kBytes${model}};\n")
endforeach()
string(APPEND text "}  // namespace topo::daemon\n")
file(WRITE ${OUTPUT} "${text}")
