# SPDX-License-Identifier: BSD-3-Clause
"""What the benchmarks have in common: running programs, keeping their results, reading them."""
