# SPDX-License-Identifier: BSD-3-Clause
"""The methods that are compared."""

# The paper's methods are on the intensities themselves and do not know what came after it.
RAW = {"photometric_model": "none", "geometric_term": "false",
       "rolling_shutter_estimation": "false", "hold_coarse_levels": "false",
       "motion_model": "constant_velocity", "surprise_deviations": "1000000"}
# OpenCV's odometries, as run_peer calls them.
PEERS = {"rgbd": "RgbdOdometry", "icp": "ICPOdometry", "rgbd_icp": "RgbdICPOdometry"}


def words(settings):
    """Parameters on a command line."""
    return [word for name in sorted(settings)
            for word in ("--set", "%s=%s" % (name, settings[name]))]


def raw_words(method):
    """One of the paper's methods on a command line."""
    return ["--method", method] + words(RAW)


# What is timed, as words for run_sequence; the default is what a user gets.
TIMED = {"ssd": raw_words("ssd"), "mi": raw_words("mi"), "hybrid": raw_words("hybrid"),
         "default": []}
