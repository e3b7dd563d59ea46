# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""toolchain/check-names on small good and bad trees."""

import unittest

from script_tree import HASH_HEAD, HEAD, TreeTest

# In two pieces, because this file is checked as well.
HOME = "/ho" + "me/somebody"


class CheckNames(TreeTest):
    script = "check-names"

    def test_accepts_a_tree_that_keeps_the_rules(self):
        self.write("core/types/pose.hpp", HEAD + "#pragma once\nint value();\n")
        self.write("core/CMakeLists.txt", HASH_HEAD + "add_subdirectory(types)\n")
        self.write("core/empty/CMakeLists.txt", "")
        self.write("toolchain/run-it", "#!/bin/bash\n" + HASH_HEAD)
        self.write("README.md", "# Name\n")
        self.assert_clean()

    def test_reports_missing_licence_lines(self):
        self.write("core/a.cpp", "int a;\n")
        self.write("core/CMakeLists.txt", "project(a)\n")
        self.write("toolchain/run-it", "#!/bin/bash\necho\n")
        self.assert_reports(
            ("core/CMakeLists.txt:1", "# SPDX-FileCopyrightText"),
            ("core/CMakeLists.txt:2", "# SPDX-License-Identifier"),
            ("core/a.cpp:1", "// SPDX-FileCopyrightText"),
            ("core/a.cpp:2", "// SPDX-License-Identifier"),
            ("toolchain/run-it:2", "# SPDX-FileCopyrightText"),
            ("toolchain/run-it:3", "# SPDX-License-Identifier"),
        )

    def test_headers_begin_with_pragma_once(self):
        self.write("core/a.hpp", HEAD + "#ifndef A_HPP\n#define A_HPP\n#endif\n")
        self.assert_reports(("core/a.hpp:1", "#pragma once"), ("core/a.hpp:3", "no include guard"))

    def test_file_names_are_snake_case(self):
        self.write("core/ScanMatcher.cpp", HEAD)
        self.write("core/scan-matcher.cpp", HEAD)
        self.assert_reports(("core/ScanMatcher.cpp:1", "snake_case"), ("core/scan-matcher.cpp:1", "snake_case"))

    def test_value_that_throws_is_banned_everywhere(self):
        self.write("daemon/a.cpp", HEAD + "int f() {\n  return load()\n      .value();\n}\nint g = node.value<int>();\nint h = error.value();\n")
        self.assert_reports(("daemon/a.cpp:4", "value() throws"))

    def test_core_has_no_thread_lock_clock_file_stream_or_dice(self):
        lines = {
            "std::thread t;": "no threads",
            "std::jthread t;": "no threads",
            "std::mutex m;": "no locks",
            "std::shared_mutex m;": "no locks",
            "std::lock_guard g{m};": "no locks",
            "std::condition_variable c;": "no locks",
            "auto t = std::chrono::steady_clock::now();": "no clock",
            "auto t = std::chrono::system_clock::now();": "no clock",
            "auto t = std::time(nullptr);": "no clock",
            "std::ofstream f;": "no file",
            "std::cerr << 1;": "no file",
            "std::filesystem::path p;": "no file",
            'fprintf(stderr, "x");': "no file",
            "std::random_device d;": "no hidden randomness",
            "int x = rand();": "no hidden randomness",
        }
        for number, line in enumerate(lines):
            self.write(f"core/a{number:02}.cpp", HEAD + line + "\n")
        self.assert_reports(*[(f"core/a{n:02}.cpp:3", why) for n, why in enumerate(lines.values())])

    def test_what_core_must_not_do_drivers_may(self):
        self.write("drivers/a.cpp", HEAD + "auto t = std::chrono::steady_clock::now();\nstd::ofstream f;\n")
        self.assert_clean()

    def test_the_name_of_a_thread_is_not_a_thread(self):
        self.write("core/a.cpp", HEAD + "std::thread::id owner = std::this_thread::get_id();\n")
        self.assert_clean()

    def test_last_words_before_an_abort_are_the_only_text(self):
        self.write(
            "core/a.cpp",
            HEAD + 'void f() {\n  std::fprintf(stderr, "%s", what);\n  std::abort();\n}\n'
            'void g() {\n  std::fprintf(stderr, "progress");\n  h();\n}\n',
        )
        self.assert_reports(("core/a.cpp:8", "no file"))

    def test_words_like_the_banned_ones_are_fine(self):
        self.write(
            "core/a.cpp",
            HEAD + "double run_time(double t);\nauto s = scan.time();\nint operand();\nauto b = path.clock(3);\n"
            'const char* text = "std::mutex";  // std::mutex, see steady_clock\n/* std::thread */\n',
        )
        self.assert_clean()

    def test_fences_and_atomic_shared_ptr_are_banned(self):
        self.write(
            "daemon/a.cpp",
            HEAD + "std::atomic_thread_fence(std::memory_order_seq_cst);\nstd::atomic<std::shared_ptr<int>> p;\n",
        )
        self.assert_reports(("daemon/a.cpp:3", "no fences"), ("daemon/a.cpp:4", "not lock-free"))

    def test_paths_of_one_machine_are_reported_in_any_text_file(self):
        self.write("README.md", f"run it\nin {HOME}/topometric\n")
        self.write("config/a.json", f'{{"path": "{HOME}/x"}}\n')
        self.assert_reports(("README.md:2", "a path of one machine"), ("config/a.json:1", "a path of one machine"))

    def test_relative_paths_urls_and_variables_are_not_machine_paths(self):
        self.write("README.md", f"https://example.org{HOME} ~{HOME} $TOP{HOME} build{HOME}\n")
        self.assert_clean()

    def test_seeded_faults_and_build_folders_are_left_out(self):
        self.write("tests/canary/seeds/bad.cpp", "std::mutex m;\n")
        self.write("build/dev/bad.cpp", "x.value();\n")
        self.assert_clean()

    def test_long_files_are_noted_and_far_too_long_ones_refused(self):
        self.write("core/long.cpp", HEAD + "int a();\n" * 460)
        done = self.run_script()
        self.assertEqual(done.returncode, 0)
        self.assertIn("core/long.cpp has 462 lines", done.stdout)
        self.write("core/long.cpp", HEAD + "int a();\n" * 900)
        self.assert_reports(("core/long.cpp:902", "902 lines"))


if __name__ == "__main__":
    unittest.main()
