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


def reasons(demo, judged, collisions):
    why = list(demo.why)
    covered, home_m = judged.get("covered"), judged.get("home_distance_m")
    if covered is not None and covered < COVERED_MIN:
        why.append("%.1f %% of the reachable area was mapped, expected at least %.0f %%" % (100 * covered, 100 * COVERED_MIN))
    if collisions:
        why.append("the robot touched something %d times" % collisions)
    if home_m is not None and home_m > HOME_MAX_M:
        why.append("the robot is %.2f m from its start, expected at most %.1f m" % (home_m, HOME_MAX_M))
    if covered is None and not why:
        why.append("nothing was judged")
    return why


def make(demo, judged):
    options, (_, truth), goals = demo.options, demo.truth_at_end(), demo.goals
    mission = demo.status.get("mission", {})
    curve = coverage(demo.samples, judged.get("covered"))
    why = reasons(demo, judged, truth["collisions"])
    run = demo.latency.get("planning", {}).get("run", {})
    cpu = demo.threads.percent()
    report = {
        "strategy": options.strategy, "robots": 1, "seed": options.seed, "fidelity": "real processes", "finish": options.finish,
        **{"t%d_s" % percent: time_to(curve, percent / 100.0) for percent in (50, 90, 95, 99)},
        "t_home_s": round(demo.elapsed_s, 1) if mission.get("state") == "done" else None,
        "limit_s": options.time_limit, "distance_m": [round(truth["path_m"], 2)], "collisions": truth["collisions"],
        **{key: goals[key] for key in ("goals_issued", "clusters_sum", "goals_sum") if key in goals},
        "decision_ms": {name: run["%s_ms" % name] for name in ("mean", "p99", "max") if "%s_ms" % name in run},
        "speedup_over_real_time": 1.0, "robot_time_lost_s": demo.lost_s,
        "cpu_percent": {**cpu, "all": round(sum(cpu.values()), 2)}, "peak_rss_mb": demo.peak_rss_mb,
    }
    report.update({key: value for key, value in judged.items() if key not in report})
    return {**report, "passed": not why, "why": why, "coverage": curve}


def text(report):
    """A pair of numbers on one line: people read it too."""
    return re.sub(r"\[\s+([-+.e\d]+),\s+([-+.e\d]+)\s+\]", r"[\1, \2]", json.dumps(report, indent=2)) + "\n"


def tell(report, out):
    cpu = report["cpu_percent"]
    print("\nmapped %s of %.0f m2 in %s s of robot time, %.0f m driven, %d collisions, %s m from the start at the end" % (
        "%.1f %%" % (100 * report["covered"]) if "covered" in report else "-", report.get("reachable_m2", 0.0),
        report["t_home_s"] if report["t_home_s"] is not None else "-", report["distance_m"][0], report["collisions"],
        "%.2f" % report["home_distance_m"] if "home_distance_m" in report else "-"))
    print("daemon: %.1f %% of a core (%s), %.0f MB at most" % (
        cpu["all"], ", ".join("%s %.1f" % item for item in cpu.items() if item[0] != "all" and item[1] >= 0.05),
        report["peak_rss_mb"]))
    print("results: %s (look at overview.png)" % out)
    print("PASSED" if report["passed"] else "FAILED:\n" + "\n".join("  " + line for line in report["why"]))
