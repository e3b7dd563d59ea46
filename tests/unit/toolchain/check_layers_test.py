# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""toolchain/check-layers on small good and bad trees, against the real table."""

import unittest

from script_tree import TreeTest


class CheckLayers(TreeTest):
    script = "check-layers"

    def setUp(self):
        super().setUp()
        self.write("core/types/pose.hpp", "#pragma once\n#include <Eigen/Core>\n#include <tl/expected.hpp>\n")
        self.write("core/grid/grid.hpp", '#include "core/types/pose.hpp"\n#include <vector>\n')
        self.write("drivers/io/stream.hpp", '#include "core/types/pose.hpp"\n#include <sys/socket.h>\n')
        self.write("drivers/hokuyo/scip.hpp", '#include "drivers/io/stream.hpp"\n')
        self.write("daemon/main.cpp", '#include "core/grid/grid.hpp"\n#include "drivers/hokuyo/scip.hpp"\n')
        self.write("tests/unit/a_test.cpp", '#include "daemon/main.cpp"\n#include <gtest/gtest.h>\n')

    def test_accepts_a_tree_that_keeps_the_layers(self):
        self.assert_clean()

    def test_reports_an_include_against_the_direction_with_file_and_line(self):
        self.write("core/types/bad.hpp", '#pragma once\n\n#  include "core/grid/grid.hpp"\n')
        self.assert_reports(("core/types/bad.hpp:3", 'core/types must not include "core/grid/grid.hpp"'))

    def test_core_sees_neither_drivers_nor_daemon_nor_tests(self):
        self.write("tests/sim/truth.hpp", "")
        self.write("daemon/clock.hpp", "")
        self.write(
            "core/pipeline/bad.cpp",
            '#include "drivers/io/stream.hpp"\n#include "daemon/clock.hpp"\n#include "tests/sim/truth.hpp"\n',
        )
        self.assert_reports(*[(f"core/pipeline/bad.cpp:{n}", "core/pipeline must not include") for n in (1, 2, 3)])

    def test_the_device_folders_do_not_know_each_other(self):
        self.write("drivers/pioneer/bad.cpp", '#include "drivers/hokuyo/scip.hpp"\n')
        self.assert_reports(("drivers/pioneer/bad.cpp:1", "drivers/pioneer must not include"))

    def test_the_simulator_has_codecs_of_its_own(self):
        self.write("tests/sim/device.cpp", '#include "drivers/io/stream.hpp"\n#include "drivers/hokuyo/scip.hpp"\n')
        self.assert_reports(("tests/sim/device.cpp:2", "tests/sim must not include"))

    def test_daemon_and_drivers_never_include_tests(self):
        self.write("tests/mocks/mock.hpp", "")
        self.write("daemon/bad.cpp", '#include "tests/mocks/mock.hpp"\n')
        self.write("drivers/io/bad.cpp", '#include "tests/mocks/mock.hpp"\n')
        self.assert_reports(("drivers/io/bad.cpp:1", "must not"), ("daemon/bad.cpp:1", "must not"))

    def test_core_takes_only_pure_headers_from_outside(self):
        self.write("core/grid/bad.cpp", "#include <vector>\n#include <thread>\n#include <sys/socket.h>\n")
        self.assert_reports(("core/grid/bad.cpp:2", "<thread>"), ("core/grid/bad.cpp:3", "<sys/socket.h>"))

    def test_a_library_that_no_room_lists_is_a_breach(self):
        self.write("core/slam/graph.cpp", "#include <ceres/ceres.h>\n")
        self.assert_reports(("core/slam/graph.cpp:1", "<ceres/ceres.h>"))

    def test_what_one_folder_owns_is_nobody_elses(self):
        self.write("daemon/link/radio.cpp", "#include <dds/dds.h>\n#include <datagram.h>\n")
        self.write("daemon/link/CMakeLists.txt", "target_link_libraries(topo_link PRIVATE CycloneDDS::ddsc)\n")
        self.assert_clean()
        self.write("daemon/app/app.cpp", "#include <dds/dds.h>\n")
        self.write("daemon/app/CMakeLists.txt", "topo_library(app SOURCES app.cpp DEPS CycloneDDS::ddsc)\n")
        self.write("tests/unit/b_test.cpp", "#include <ddsc/dds.h>\n")
        self.assert_reports(
            ("daemon/app/app.cpp:1", "daemon must not include <dds/dds.h>"),
            ("tests/unit/b_test.cpp:1", "tests must not include <ddsc/dds.h>"),
            ("daemon/app/CMakeLists.txt:1", "daemon must not link CycloneDDS::ddsc"),
        )

    def test_ways_around_the_check_are_breaches(self):
        self.write(
            "core/types/bad.cpp",
            '#include "../grid/grid.hpp"\n#include <core/grid/grid.hpp>\n#include HEADER\n#include "pose.hpp"\n'
            '#include "core/types/gone.hpp"\n',
        )
        self.assert_reports(
            ("core/types/bad.cpp:1", "from the top of the tree"),
            ("core/types/bad.cpp:2", "double quotes"),
            ("core/types/bad.cpp:3", "write the name itself"),
            ("core/types/bad.cpp:4", "from the top of the tree"),
            ("core/types/bad.cpp:5", "no such file"),
        )

    def test_comments_and_strings_are_not_include_lines(self):
        self.write(
            "core/types/good.cpp",
            '// #include "core/grid/grid.hpp"\n/*\n#include "daemon/main.cpp"\n*/\nauto url = "http://x";\n',
        )
        self.assert_clean()

    def test_a_comment_marker_in_a_literal_hides_nothing(self):
        self.write("core/types/bad.cpp", 'auto a = "/*";\n#include "core/grid/grid.hpp"\nauto b = "*/";\n')
        self.assert_reports(("core/types/bad.cpp:2", "must not include"))

    def test_a_folder_that_the_table_does_not_know_is_a_breach(self):
        self.write("core/misc/new.cpp", "\n")
        self.assert_reports(("core/misc/new.cpp:1", "not in toolchain/layers.toml"))

    def test_link_lines_keep_the_layers_too(self):
        self.write("core/grid/CMakeLists.txt", "topo_library(grid SOURCES grid.cpp DEPS topo_types)\n")
        self.write(
            "core/types/CMakeLists.txt",
            "topo_library(types\n  SOURCES a.cpp\n  DEPS Eigen3::Eigen\n       topo_grid  # upwards\n  spdlog::spdlog)\n",
        )
        self.assert_reports(
            ("core/types/CMakeLists.txt:4", "must not link topo_grid (core/grid)"),
            ("core/types/CMakeLists.txt:5", "must not link spdlog::spdlog"),
        )

    def test_target_link_libraries_is_read_as_well(self):
        self.write("daemon/CMakeLists.txt", "topo_library(daemon SOURCES main.cpp)\n")
        self.write("drivers/io/CMakeLists.txt", "topo_library(io)\ntarget_link_libraries(topo_io PRIVATE topo_daemon)\n")
        self.assert_reports(("drivers/io/CMakeLists.txt:2", "must not link topo_daemon"))

    def test_an_empty_folder_is_an_error_and_not_a_pass(self):
        empty = self.root / "empty"
        empty.mkdir()
        done = self.run_script("--root", str(empty))
        self.assertEqual(done.returncode, 2, done.stdout)


if __name__ == "__main__":
    unittest.main()
