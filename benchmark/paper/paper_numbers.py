# SPDX-License-Identifier: BSD-3-Clause
"""What the paper reports: K. S. Shankar and N. Michael, "Robust Direct Visual Odometry using Mutual
Information", 2016, Tables I to III. Errors are (mean, standard deviation), meters and radians."""

# Level: SSD, MI and hybrid in ms on a desktop i7 at 640x480.
TABLE_1 = {
    "4": (0.5, 3.7, 3.9), "3": (1.8, 11.1, 9.0), "2": (1.2, 16.1, 12.7), "1": (2.4, 84.5, 1.8),
    "0": (6.2, 169.7, 5.6), "all": (13.7, 287.3, 35.0)}

# (trajectory, lighting): method: translation, rotation.
TABLE_2 = {
    ("translation", "constant"): {
        "mi": ((7.791e-3, 5.232e-3), (9.598e-3, 6.254e-3)),
        "ssd": ((7.792e-3, 5.220e-3), (9.598e-3, 6.253e-3)),
        "hybrid": ((7.792e-3, 5.220e-3), (9.599e-3, 6.253e-3))},
    ("translation", "oscillating"): {
        "mi": ((1.413e-2, 1.072e-2), (1.040e-2, 0.661e-2)),
        "ssd": ((1.439e-2, 1.314e-2), (1.073e-2, 0.825e-2)),
        "hybrid": ((1.382e-2, 0.977e-2), (1.036e-2, 0.608e-2))},
    ("rotation", "constant"): {
        "mi": ((6.506e-3, 3.566e-3), (2.397e-2, 1.459e-2)),
        "ssd": ((6.531e-3, 3.545e-3), (2.397e-2, 1.457e-2)),
        "hybrid": ((6.531e-3, 3.543e-3), (2.397e-2, 1.458e-2))},
    ("rotation", "oscillating"): {
        "mi": ((1.172e-2, 1.287e-2), (3.630e-2, 2.606e-2)),
        "ssd": ((1.265e-2, 2.929e-2), (3.760e-2, 3.007e-2)),
        "hybrid": ((1.060e-2, 0.776e-2), (3.622e-2, 2.558e-2))}}

TABLE_3 = {
    "s1": {"mi": ((1.4e-3, 1.3e-3), (0.48e-3, 0.52e-3)), "ssd": ((7.3e-1, 9.0e-1), (2.6e-1, 3.2e-1)),
           "hybrid": ((11.7e-3, 12.9e-3), (2.34e-3, 2.72e-3))},
    "s2": {"mi": ((1.3e-3, 0.7e-3), (0.8e-3, 0.5e-3)),
           "ssd": ((3.14e-2, 3.97e-2), (8.0e-2, 10.3e-2)),
           "hybrid": ((3.24e-3, 3.20e-3), (1.62e-3, 1.63e-3))}}
