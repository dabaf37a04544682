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
    return "{} {}".format(rounded(factor * duration, 3), unit)


def tolerance(error):
    return "{:.0e} m".format(error).replace("e-0", "e-")


def setting(name, value):
    if name == "step":
        return "a step of " + seconds(value)
    if name == "tolerance":
        return "a tolerance of " + rounded(value)
    return counted(name, "{:.0f}".format(value))


def settings(name, values):
    """Several of one ladder, in a row."""
    if len(values) == 1:
        return setting(name, values[0])
    if name == "step":
        return "steps of " + listed([seconds(value) for value in values])
    if name == "tolerance":
        return "tolerances of " + listed([rounded(value) for value in values])
    return counted(name, listed(["{:.0f}".format(value) for value in values]))


def setting_range(name, values):
    """The least and the greatest of some values of a ladder, in short."""
    ends = sorted({min(values), max(values)})
    if name == "step":
        factor, unit = unit_of(ends[0])
        return "{} {}".format(" to ".join(rounded(factor * value) for value in ends), unit)
    if name == "tolerance":
        return "tolerance " + " to ".join(rounded(value) for value in ends)
    return counted(name, " to ".join("{:.0f}".format(value) for value in ends))


def counted(name, numbers):
    if name == "iterations":
        return "1 iteration" if numbers == "1" else numbers + " iterations"
    return numbers + " nodes a side"


def listed(words):
    return ", ".join(words[:-1]) + (" and " if len(words) > 1 else "") + words[-1]


def times(factor):
    return "{} times".format(rounded(factor, 3 if 0.5 < factor < 2.0 else 2))
