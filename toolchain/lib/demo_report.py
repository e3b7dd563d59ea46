# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the demonstration found, as report.json and in words."""

import json
import re

COVERED_MIN = 0.95
HOME_MAX_M = 0.5
COVERAGE_POINTS = 200


def coverage(samples, covered):
    """Over time: the area that the robot knew, scaled so that its end is what was judged. [[t_s, fraction], ...]"""
    last = samples[-1][1] if samples else 0.0
    if not last or covered is None:
        return []
    step = max(1, len(samples) // COVERAGE_POINTS)
    chosen = samples[::step] + ([samples[-1]] if (len(samples) - 1) % step else [])
    return [[round(t, 1), round(known / last * covered, 4)] for t, known in chosen]


def time_to(curve, fraction):
    return next((t for t, share in curve if share >= fraction), None)


def reasons(demo, judged, truths):
    why = list(demo.why)
    for robot, verdict, truth in zip(demo.robots, judged, truths):
        covered, home_m = verdict.get("covered"), verdict.get("home_distance_m")
        if covered is not None and covered < COVERED_MIN:
            why.append("%.1f %% of the reachable area is in the map of %s, expected at least %.0f %%" %
                       (100 * covered, robot.name, 100 * COVERED_MIN))
        if truth["collisions"]:
            why.append("%s touched something %d times" % (robot.name, truth["collisions"]))
        if home_m is not None and home_m > HOME_MAX_M:
            why.append("%s is %.2f m from its start, expected at most %.1f m" % (robot.name, home_m, HOME_MAX_M))
        if covered is None and not why:
            why.append("nothing was judged")
    return why


def of_robot(robot, verdict):
    cpu = robot.threads.percent()
    report = {"t_home_s": robot.home_s, "home_distance_m": verdict.get("home_distance_m"), "covered": verdict.get("covered"),
              "cpu_percent": round(sum(cpu.values()), 2), "peak_rss_mb": robot.peak_rss_mb}
    if robot.options.robots > 1:
        exchange = robot.team.get("exchange", {})
        report.update({"sent_bytes": exchange.get("sent_bytes"), "received_bytes": exchange.get("received_bytes"),
                       "held_hash": robot.team.get("held", {}).get("hash"),
                       "link_cpu_percent": round(sum(robot.link_threads.percent().values()), 2),
                       "link_peak_rss_mb": robot.link_threads.peak_rss_mb()})
    return report


def of_radio(demo):
    """`equal_s`: from the end of each cut, and from the end of the last mission, until all robots were seen to hold the same,
    which while they drive is so for a moment now and then; `caught_up_s`: until none lacked much of what others held."""
    radio, record = demo.options.radio, demo.record
    return {"text": demo.options.radio_text, "links": "loopback" if demo.air.network is None else "namespaces",
            "gaps_s": demo.air.gaps,
            "cuts": [{"from_s": begin, "to_s": end, "caught_up_s": record.caught_up_after(end),
                      "equal_s": record.equal_after(end)} for begin, end in radio.cuts],
            "equal_s": record.equal_after(max(demo.ended_s, radio.last_cut_end_s()))}


def make(demo, judged):
    options, (_, truths) = demo.options, demo.last_truths
    first, verdict = demo.robots[0], judged[0]
    curve = coverage(demo.record.best_known(), verdict.get("covered"))
    why = reasons(demo, judged, truths)
    run = first.latency.get("planning", {}).get("run", {})
    cpu = first.threads.percent()
    all_home = all(robot.status.get("mission", {}).get("state") == "done" for robot in demo.robots)
    report = {
        "strategy": options.strategy, "robots": options.robots, "seed": options.seed, "fidelity": "real processes",
        "finish": options.finish, "v_max_mps": options.speed,
        **{"t%d_s" % percent: time_to(curve, percent / 100.0) for percent in (50, 90, 95, 99)},
        "t_home_s": round(demo.ended_s, 1) if all_home else None,
        "limit_s": options.time_limit, "distance_m": [round(truth["path_m"], 2) for truth in truths],
        "collisions": sum(truth["collisions"] for truth in truths),
        **{key: first.goals[key] for key in ("goals_issued", "clusters_sum", "goals_sum") if key in first.goals},
        "decision_ms": {name: run["%s_ms" % name] for name in ("mean", "p99", "max") if "%s_ms" % name in run},
        "speedup_over_real_time": 1.0, "robot_time_lost_s": demo.lost_s,
        "cpu_percent": {**cpu, "all": round(sum(cpu.values()), 2)}, "peak_rss_mb": first.peak_rss_mb,
        "page_faults_per_s": first.threads.faults_per_s(),
    }
    report.update({key: value for key, value in verdict.items() if key not in report})
    if options.robots > 1:
        report["each"] = [of_robot(*pair) for pair in zip(demo.robots, judged)]
        report["radio"] = of_radio(demo)
    return {**report, "passed": not why, "why": why, "coverage": curve}


def text(report):
    """A pair of numbers on one line: people read it too."""
    return re.sub(r"\[\s+([-+.e\d]+),\s+([-+.e\d]+)\s+\]", r"[\1, \2]", json.dumps(report, indent=2)) + "\n"


def tell(report, out):
    cpu = report["cpu_percent"]
    print("\nmapped %s of %.0f m2 in %s s of robot time, %s m driven, %d collisions, %s m from the start at the end" % (
        "%.1f %%" % (100 * report["covered"]) if "covered" in report else "-", report.get("reachable_m2", 0.0),
        report["t_home_s"] if report["t_home_s"] is not None else "-", " and ".join("%.0f" % way for way in report["distance_m"]), report["collisions"],
        "%.2f" % report["home_distance_m"] if "home_distance_m" in report else "-"))
    print("daemon: %.1f %% of a core (%s), %.0f MB at most" % (
        cpu["all"], ", ".join("%s %.1f" % item for item in cpu.items() if item[0] != "all" and item[1] >= 0.05),
        report["peak_rss_mb"]))
    for number, each in enumerate(report.get("each", []), 1):
        print("robot %d: home after %s s, %s of the area in its map, %.1f kB sent, link %.1f %% of a core" % (
            number, "-" if each["t_home_s"] is None else "%.1f" % each["t_home_s"], "-" if each["covered"] is None else "%.1f %%" % (100 * each["covered"]),
            (each["sent_bytes"] or 0) / 1e3, each["link_cpu_percent"]))
    for cut in report.get("radio", {}).get("cuts", []):
        print("cut from %g to %g s: caught up %s s after it, all held the same %s s after it" % (
            cut["from_s"], cut["to_s"], *("-" if cut[key] is None else cut[key] for key in ("caught_up_s", "equal_s"))))
    print("results: %s (look at %s)" % (out, "ways.png, coverage.png and goals.png" if "each" in report else "overview.png"))
    print("PASSED" if report["passed"] else "FAILED:\n" + "\n".join("  " + line for line in report["why"]))
