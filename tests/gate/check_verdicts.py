#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks what the gate says of rows, with made-up values."""
import math

from verdicts import Row, at_most, same, verdict, within


def check(what, found, expected):
    assert found == expected, f"{what}: {found!r}, not {expected!r}"


def main():
    def measured(*values):
        return within("s", "q", values, 0.9, 1.1, "0.9 to 1.1")

    check("within", verdict(measured(1.0, 1.01, 1.02), None), "ok")
    check("within, where it was", verdict(measured(1.0, 1.01, 1.02), measured(1.0, 1.01, 1.02)), "ok")
    check("within, elsewhere", verdict(measured(1.05), measured(1.0)), "ok; moved")
    check("not within", verdict(measured(1.2), measured(1.0)), "fails")
    check("not within, nothing before", verdict(measured(1.2), None), "fails")
    check("not within, nor before", verdict(measured(1.2), measured(1.2)), "fails, as before")
    check("further off", verdict(measured(1.4), measured(1.2)), "fails, as before; moved")
    check("not a number", verdict(measured(math.nan), measured(1.0)), "fails")

    def still(*values):
        return same("s", "q", values)

    check("nothing before", verdict(still(1.0), None), "new")
    check("2 %", verdict(still(1.019), still(1.0)), "ok")
    check("3 %", verdict(still(1.03), still(1.0)), "fails")
    check("3 % among seeds that scatter", verdict(still(1.0, 1.03, 1.06), still(0.97, 1.0, 1.03)), "ok")
    check("as before, not a number", verdict(still(math.nan), still(1.0)), "fails")

    def deep(*values, floor=0.0, of_median=False):
        return at_most("s", "q", values, 1.15, 1.3, floor, of_median=of_median)

    check("less", verdict(deep(0.5), deep(1.0)), "ok")
    check("up to the goal", verdict(deep(1.14), deep(1.0)), "ok")
    check("above the goal", verdict(deep(1.2), deep(1.0)), "above the goal")
    check("more than must be", verdict(deep(1.31), deep(1.0)), "fails")
    check("more, not a number", verdict(deep(math.nan), deep(1.0)), "fails")
    check("still so small that it does not matter", verdict(deep(1e-6, floor=1e-5), deep(1e-9, floor=1e-5)), "ok")
    check("a bed in which a grain slips", verdict(deep(1, 1, 1000, of_median=True), deep(1, 1, 1, of_median=True)), "ok")

    def hard(passed):
        return Row("s", "q", (), "", passed=passed, text="1")

    check("a hard case", verdict(hard(True), hard(False)), "ok")
    check("a hard case that fails", verdict(hard(False), hard(True)), "fails")
    check("a hard case that failed", verdict(hard(False), hard(False)), "fails, as before")


if __name__ == "__main__":
    main()
