"""Numbers and names as the charts and the summary write them."""

STATUS_WORDS = {"unstable": "unstable", "not_converged": "not converged", "too_slow": "too slow"}


def rounded(number, digits=2):
    """To so many digits, without exponent where that reads well."""
    if number == 0.0 or 1e-3 <= abs(number) < 1e5:
        text = "{:.{}g}".format(number, digits)
        return "{:.0f}".format(float(text)) if "e" in text else text
    mantissa, exponent = "{:.{}e}".format(number, digits - 1).split("e")
    return "{}e{}".format(mantissa, int(exponent))


def unit_of(duration):
    for factor, unit, least in ((1.0, "s", 1.0), (1e3, "ms", 1e-5)):
        if duration >= 0.9995 * least:
            return factor, unit
    return 1e6, "us"


def seconds(duration):
    factor, unit = unit_of(duration)
    return "{} {}".format(rounded(factor * duration), unit)


def tolerance(error):
    return "{:.0e} m".format(error).replace("e-0", "e-")


def setting(name, value):
    if name == "step":
        return "a step of " + seconds(value)
    if name == "tolerance":
        return "a tolerance of " + rounded(value)
    if name == "iterations":
        return "{:.0f} iterations".format(value)
    return "{:.0f} nodes a side".format(value)


def settings(name, values):
    """Several of one ladder, in a row."""
    if name == "step":
        return "steps of " + listed([seconds(value) for value in values])
    if name == "tolerance":
        return "tolerances of " + listed([rounded(value) for value in values])
    return "{} {}".format(listed(["{:.0f}".format(value) for value in values]),
                          {"iterations": "iterations", "nodes_per_side": "nodes a side"}[name])


def listed(words):
    return ", ".join(words[:-1]) + (" and " if len(words) > 1 else "") + words[-1]


def times(factor):
    return "{} times".format(rounded(factor))


def setting_range(name, values):
    """The least and the greatest of some values of a ladder."""
    ends = sorted({min(values), max(values)})
    factor, unit = unit_of(ends[0]) if name == "step" else (1.0, {"iterations": "iterations"}.get(name, ""))
    return "{} {}".format(" to ".join(rounded(factor * value, 3) for value in ends), unit).strip()
