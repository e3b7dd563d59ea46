# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""Links as real processes, on the loopback and, where that is permitted, in network namespaces.

usage: link_test.py PROGRAMS SOURCES [unittest's arguments]"""
import os
import pathlib
import random
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from link_rig import WHY_NOT, Network, Robot  # noqa: E402
from team_network import address  # noqa: E402

PROGRAMS, SOURCES = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
TEAM = SOURCES / "daemon/link/topometric-team"


def team(*words):
    return subprocess.run([TEAM, *map(str, words)], capture_output=True, text=True, check=False, timeout=60)


class Links(unittest.TestCase):
    domain = 0

    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="topo-link-")
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        Links.domain += 1  # what an earlier test leaves in the air is not heard

    def robot(self, number, **options):
        made = Robot(PROGRAMS, self.folder, number, domain=20 + Links.domain, **options)
        self.addCleanup(made.close)
        return made

    def credentials(self, folder, name, *robots):
        made = team("new", self.folder / folder, "--name", name)
        self.assertEqual(made.returncode, 0, made.stderr)
        for robot in robots:
            self.assertEqual(team("add", robot, self.folder / folder).returncode, 0)
        return [self.folder / folder / ("robot-%d" % robot) for robot in robots]

    def hear_each_other(self, *robots):
        for one in robots:
            for other in robots:
                if one is not other:
                    one.hears(other.number)


class OnTheLoopback(Links):
    def test_datagrams_flow_both_ways(self):
        one, two = self.robot(1, size=1200).start(), self.robot(2).start()
        self.hear_each_other(one, two)
        status, _ = one.wait("a mate", lambda s: s["mates"] == 1)
        self.assertTrue(status["radio"])
        self.assertEqual(status["news"], ["joined"])
        for robot in (one, two):
            self.assertEqual(robot.stop_link()[0], 0)

    def test_a_killed_link_is_alone_once_and_comes_back(self):
        one, two = self.robot(1).start(), self.robot(2).start()
        self.hear_each_other(one, two)
        one.stop_link(signal.SIGKILL)
        one.wait("alone", lambda s: not s["joined"])
        one.next_statuses(5)
        self.assertEqual(one.status["news"], ["joined", "alone"])
        one.start()
        self.hear_each_other(one, two)
        self.assertEqual(one.status["news"], ["joined", "alone", "joined"])

    def test_a_daemon_that_ends_is_waited_for(self):
        one, two = self.robot(1).start(), self.robot(2).start()
        self.hear_each_other(one, two)
        one.restart_end()
        self.hear_each_other(one, two)
        self.assertIsNone(one.link.poll())

    def test_a_stopped_link_does_not_hold_the_daemon(self):
        one, two = self.robot(1, period_ms=2, size=1200).start(), self.robot(2).start()
        self.hear_each_other(one, two)
        one.link.send_signal(signal.SIGSTOP)
        try:
            one.wait("a full socket", lambda s: s["full"] > 0)
            one.wait("alone", lambda s: not s["joined"])
            one.next_statuses(5)
            self.assertEqual(one.status["news"], ["joined", "alone"])
        finally:
            one.link.send_signal(signal.SIGCONT)
        self.hear_each_other(one, two)
        self.assertEqual(one.status["news"], ["joined", "alone", "joined"])

    def test_another_team_is_counted_and_not_heard(self):
        one, two = self.robot(1).start(), self.robot(2).start()
        stranger = self.robot(3, team="warehouse").start()
        self.hear_each_other(one, two)
        one.wait("another team's", lambda s: s["dropped"]["another team"] >= 10)
        stranger.wait("another team's", lambda s: s["dropped"]["another team"] >= 10)
        self.assertEqual((one.heard(3), two.heard(3), stranger.status["heard"]), (0, 0, {}))

    def test_one_number_twice_is_seen_by_both(self):
        one, two = self.robot(1).start(), self.robot(1).start()
        for robot in (one, two):
            robot.wait("its own number", lambda s: s["dropped"]["own number used by another robot"] >= 10)
            self.assertEqual(robot.status["heard"], {})

    def test_a_daemon_of_another_team_is_refused(self):
        one = self.robot(1)
        text = one.config.read_text()
        one.config.write_text(text.replace('name = "office"', 'name = "warehouse"'))
        one.start()
        one.wait("refused", lambda s: s["news"] == ["refused"])
        one.next_statuses(5)
        self.assertFalse(one.status["joined"])
        self.assertIn("do not fit", one.log.read_text())

    def test_noise_changes_nothing(self):
        one, two = self.robot(1).start(), self.robot(2).start()
        self.hear_each_other(one, two)
        noise = random.Random(1)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            ports = [7400 + 250 * (20 + Links.domain) + d for d in (0, 1, 10, 11, 12, 13)]
            for _ in range(3000):
                content = noise.randbytes(noise.choice((0, 3, 20, 200, 1400)))
                head = b"RTPS\x02\x01\x01\x10" if noise.random() < 0.5 else b""
                sender.sendto(head + content, ("127.0.0.1", noise.choice(ports)))
        self.hear_each_other(one, two)
        self.assertEqual((one.status["news"], two.status["news"]), (["joined"], ["joined"]))
        self.assertEqual(set(one.status["heard"]), {"2"})


class Trust(Links):
    def test_robots_of_one_team_hear_each_other(self):
        a, b = self.credentials("office", "office", 1, 2)
        one, two = self.robot(1, security=a, size=1200).start(), self.robot(2, security=b).start()
        self.hear_each_other(one, two)

    def test_wrong_credentials_and_none_are_not_matched(self):
        a, b = self.credentials("office", "office", 1, 2)
        (c,) = self.credentials("false", "office", 3)  # the same name, another authority
        one, two = self.robot(1, security=a).start(), self.robot(2, security=b).start()
        wrong, none = self.robot(3, security=c).start(), self.robot(4).start()
        for robot in (wrong, none):
            robot.wait("the radio", lambda s: s["radio"] and s["radio_sent"] > 0)
        # Longer than the two that belong together took by far: they are heard a hundred times more.
        one.hears(2, 100)
        two.hears(1, 100)
        for robot in (one, two):
            self.assertEqual((robot.heard(3), robot.heard(4), robot.status["mates"]), (0, 0, 1))
        for robot in (wrong, none):
            self.assertEqual((robot.status["heard"], robot.status["mates"]), ({}, 0))

    def test_a_number_belongs_to_its_credentials(self):
        a, b = self.credentials("office", "office", 1, 2)
        one = self.robot(1, security=a).start()
        command = [PROGRAMS / "false_number", b, str(20 + Links.domain), "office"]
        with subprocess.Popen([*command, "2", "3"], stdin=subprocess.PIPE) as stray:
            status, _ = one.wait("a false number", lambda s: s["dropped"]["under a false number"] >= 10)
            self.assertEqual(status["heard"], {})
            stray.stdin.close()
            self.assertEqual(stray.wait(60), 0)
        # In the partition of the number that it says its own permissions do not let it write.
        with subprocess.Popen([*command, "3", "3"], stdin=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as stray:
            self.assertEqual(stray.wait(60), 3)
            self.assertIn('"topometric-team add 3" makes anew', stray.stderr.read())

    def refusal(self, *texts, **options):
        status, words = self.robot(1, **options).refused()
        self.assertEqual(status, 2, words)
        for text in texts:
            self.assertIn(text, words)

    def test_without_a_word_on_security_it_does_not_start(self):
        self.refusal("team.security is missing", '"off"', security=None)

    def test_credentials_that_are_not_there_are_refused(self):
        self.refusal("identity-ca.pem: No such file", security=self.folder)

    def test_a_key_that_others_may_read_is_refused(self):
        (a,) = self.credentials("office", "office", 1)
        os.chmod(a / "identity-key.pem", 0o644)
        self.refusal("identity-key.pem: found mode 0644", "chmod 600", security=a)

    def test_rules_that_others_may_write_are_refused(self):
        (a,) = self.credentials("office", "office", 1)
        os.chmod(a / "permissions.p7s", 0o666)
        self.refusal("permissions.p7s: found mode 0666", "chmod 644", security=a)

    def test_another_robots_credentials_are_refused(self):
        (b,) = self.credentials("office", "office", 2)
        self.refusal("found the credentials of robot-2 of team office, expected robot-1 of team office", security=b)

    def test_the_maker_of_credentials_refuses_with_words(self):
        self.credentials("office", "office", 1)
        for words, said in (((), "expected new, add or list"), (("new", self.folder / "office"), "is there already"),
                            (("add", "251", self.folder / "office"), "expected a number from 1 to 250"),
                            (("add", "1", self.folder), "found no team there"),
                            (("new", self.folder / "x", "--name", "two words"), "expected 1 to 32 letters")):
            done = team(*words)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(said, done.stderr)
        self.assertRegex(team("list", self.folder / "office").stdout, r"(?s)^team office\nrobot-1: until .* GMT\n$")


@unittest.skipIf(WHY_NOT, "no network namespaces here: %s" % WHY_NOT)
class InNamespaces(Links):
    def setUp(self):
        super().setUp()
        self.network = Network((1, 2, 3))
        self.addCleanup(self.network.close)

    def robot(self, number, **options):
        return super().robot(number, interface="radio", inside=self.network.rooms[number], **{"peers": [], **options})

    def plugged(self, *numbers, **options):
        robots = []
        for number in numbers:
            self.network.plug(number)
            robots.append(self.robot(number, **options).start())
        self.hear_each_other(*robots)
        return robots

    def test_data_go_once_to_all(self):
        one, _, _ = self.plugged(1, 2, 3, size=1200)
        one.wait("mates", lambda s: s["mates"] == 2)
        before, sent = self.network.packets(1), one.status["radio_sent"]
        status, _ = one.wait("traffic", lambda s: s["radio_sent"] >= sent + 200)
        packets = self.network.packets(1) - before
        # One frame a datagram, whoever hears it; discovery and what was sent after the status come on top.
        self.assertLess(packets, 1.5 * (status["radio_sent"] - sent), "data go to each mate by itself, or in fragments")

    def test_an_encrypted_datagram_is_one_frame(self):
        folders = self.credentials("office", "office", 1, 2)
        robots = []
        for number, folder in zip((1, 2), folders):
            self.network.plug(number)
            robots.append(self.robot(number, security=folder, size=1200).start())
        self.hear_each_other(*robots)
        before, sent = self.network.packets(1), robots[0].status["radio_sent"]
        status, _ = robots[0].wait("traffic", lambda s: s["radio_sent"] >= sent + 200)
        self.assertLess(self.network.packets(1) - before, 1.5 * (status["radio_sent"] - sent))

    def test_listed_peers_need_no_multicast(self):
        for number in (1, 2):
            self.network.plug(number)
            self.network.inside(number, "link", "set", "radio", "multicast", "off")
        one = self.robot(1, peers=[address(2)]).start()
        two = self.robot(2, peers=[address(1)]).start()
        self.hear_each_other(one, two)

    def test_an_absent_interface_is_waited_for(self):
        self.network.plug(2)
        one, two = self.robot(1).start(), self.robot(2).start()
        one.wait("the link", lambda s: s["joined"] and s["dropped"]["no radio"] > 10)
        self.assertFalse(one.status["radio"])
        self.network.plug(1)
        self.hear_each_other(one, two)

    def test_an_interface_that_goes_down_and_comes_back(self):
        one, two = self.plugged(1, 2)
        self.network.inside(1, "link", "set", "radio", "down")
        one.wait("no radio", lambda s: not s["radio"])
        one.next_statuses(20)
        self.assertTrue(one.status["joined"])
        self.network.inside(1, "link", "set", "radio", "up")
        self.hear_each_other(one, two)
        self.assertEqual((one.status["news"], two.status["news"]), (["joined"], ["joined"]), "the daemon saw nothing of it")

    def test_an_interface_that_is_pulled_and_plugged_again(self):
        one, two = self.plugged(1, 2)
        self.network.unplug(1)
        one.wait("no radio", lambda s: not s["radio"])
        self.network.plug(1)
        self.hear_each_other(one, two)
        self.assertEqual(one.status["news"], ["joined"])

    def test_another_address(self):
        one, two = self.plugged(1, 2)
        self.network.inside(1, "addr", "flush", "dev", "radio")
        self.network.inside(1, "addr", "add", "10.77.0.101/24", "dev", "radio")
        one.wait("the radio", lambda s: s["radio"])
        self.hear_each_other(one, two)

    @unittest.skipUnless(shutil.which("nft"), "no nft here")
    def test_where_a_third_is_lost_the_rest_arrives(self):
        self.network.plug(1)
        self.network.plug(2)
        for number in (1, 2):
            self.network.lose(number, 30)
        folders = self.credentials("office", "office", 1, 2)
        one, two = (self.robot(n, security=folder, period_ms=5).start() for n, folder in zip((1, 2), folders))
        # A handshake that is left half done is begun anew after 15 to 25 s.
        one.hears(2, patience=100)
        two.hears(1, patience=100)
        sent, heard = self.counted(one, two)
        one.wait("traffic", lambda s: s["radio_sent"] >= sent + 600)
        sent_then, heard_then = self.counted(one, two)
        share = (heard_then - heard) / (sent_then - sent)
        self.assertTrue(0.5 < share < 0.9, share)

    @staticmethod
    def counted(one, two):
        """What one sent and two heard of it, both at the same time: the newest lines of both are of this moment."""
        one.next_status()
        two.next_status()
        return one.status["radio_sent"], two.heard(1)

    def test_it_ends_while_the_interface_is_down(self):
        one, _ = self.plugged(1, 2, period_ms=5)
        self.network.inside(1, "link", "set", "radio", "down")
        one.wait("no radio", lambda s: not s["radio"])
        status, took_s = one.stop_link()
        self.assertEqual(status, 0)
        self.assertLess(took_s, 5.0)

    def test_a_mate_that_is_out_of_reach_holds_nothing(self):
        one, two = self.plugged(1, 2, period_ms=5)
        self.network.inside(2, "link", "set", "radio", "down")
        sent = one.status["radio_sent"]
        one.wait("sending on", lambda s: s["radio_sent"] >= sent + 500)
        self.network.inside(2, "link", "set", "radio", "up")
        self.hear_each_other(one, two)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
