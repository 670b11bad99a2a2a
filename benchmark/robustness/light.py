# SPDX-License-Identifier: BSD-3-Clause
"""RPE over 1 s under each lighting, and its ratio to constant light."""

import os

import judging
from bench import FILMED_LIGHT, cell
from measuring.progress import Progress
from measuring.statistics import quantile, rpe

RELIT = ["ramp_step", "oscillating", "spot", "gradient", "gamma", "auto_exposure", "inversion"]


def sequences_of(bench):
    """(name, light, kind, what makes the folder) each."""
    tasks = [(f"{scene} {path}", name, "generated",
              lambda s=scene, e=seed, p=path, n=name: bench.filmed(s, e, p, n))
             for scene, seed in bench.scenes for path in bench.paths for name in FILMED_LIGHT]
    return tasks + [(os.path.basename(recording), name, "recording",
                     lambda r=recording, n=name: bench.relit(r, n))
                    for recording in bench.recordings() for name in ["constant"] + RELIT]


def light(bench):
    tasks = sequences_of(bench)
    rows, default, peers, progress = [], {}, {}, Progress(len(tasks), "sequences of light")
    for name, lamps, kind, folder_of in tasks:
        folder = folder_of()
        results = {method: bench.run(method, folder) for method in bench.methods}
        rows.append([name, lamps] + [cell(results[method]) for method in bench.methods])
        if "mivo" in results:
            which = "median" if name.startswith("tum") else "rmse"
            default[name, lamps] = (kind, rpe(results["mivo"], which))
            rows[-1].append(bench.wrong(results["mivo"], folder))
        peers[name, lamps] = min((rpe(results[m])[0] for m in ("rgbd", "rgbd_icp") if m in results),
                                 default=None)
        progress.step(f"{name} {lamps}")
    progress.close()
    wrong = ["mivo: undetected errors"] if default else []
    bench.say_table("Light: RPE over 1 s, m deg", ["sequence", "light"] + bench.methods + wrong, rows,
                    judging.WRONG_TEXT)
    judge_light(bench, default, peers)


def judge_light(bench, default, peers):
    if not default:
        return
    ratios, generated = [], []
    for (name, lamps), (kind, (meters, degrees)) in default.items():
        if lamps != "constant":
            base = default[name, "constant"][1]
            ratios.append((meters / base[0], degrees / base[1], f"{name} {lamps}"))
        if kind == "generated":
            generated.append((meters, degrees, f"{name} {lamps}"))
    worst = max(ratios, key=lambda row: row[0])
    bench.say(f"\nchanging light against constant light: worst RPE ratio {worst[0]:.2f} ({worst[2]}), "
              f"{sum(row[0] > 1.10 for row in ratios)} of {len(ratios)} above 1.10; rotation worst "
              f"{max(row[1] for row in ratios):.2f}")
    bench.say("generated: RPE median {:.4f} m {:.3f} deg, worst {:.4f} m ({}) {:.3f} deg".format(
        quantile([row[0] for row in generated], 0.5),
        quantile([row[1] for row in generated], 0.5), max(generated)[0], max(generated)[2],
        max(row[1] for row in generated)))
    shares = [default[key][1][0] / peer for key, peer in peers.items() if peer and
              default[key][0] == "generated"]
    if shares:
        bench.say(f"generated: at most {max(shares):.3f} of the better one of OpenCV, median "
                  f"{quantile(shares, 0.5):.3f}")
