"""Certificates in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from singletrack.certify import Certificate, CertifiedCrossing

__all__ = ["certificate_text"]

_KINDS = {"pair": "weave speed", "real": "capsize speed", "both": "both at once"}


def certificate_text(certificate: Certificate) -> str:
    """Return a certificate in words: critical speeds with the digits that are proven, ranges rounded inwards.

    Parameters
    ----------
    certificate : Certificate

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> print(certificate_text(coefficients(load_bicycle("benchmark")).critical_speeds(certify=True)))
    certified       for the parameters as written, at every speed (128 bits)
    weave speed     4.29238253634 m/s (gained)
    capsize speed   6.02426201539 m/s (lost)
    unstable (2)    0 to 4.292382536 m/s
    stable          4.292382537 to 6.024262015 m/s
    unstable (1)    from 6.024262016 m/s on
    at rest         2 roots to the right, 2 to the left, 0 on the axis
    """
    lines = [(certificate.status, f"{_scope(certificate)} ({certificate.bits} bits{_boxes(certificate)})")]
    lines += [(_KINDS[crossing.kind], _crossing_words(crossing)) for crossing in certificate.crossings]
    lines += [(f"unstable ({each.unstable})" if each.unstable else "stable", each.words) for each in certificate.ranges]
    if certificate.always:
        lines.append(("never stable", certificate.always))
    lines += [("undecided", words) for words in certificate.undecided_words]
    rest = certificate.at_rest
    if rest is None:
        lines.append(("at rest", "undecided"))
    else:
        on = f"{rest.axis} on the axis" + (f" ({rest.zero} of them zero)" if rest.zero else "")
        lines.append(("at rest", f"{rest.right} roots to the right, {rest.left} to the left, {on}"))
    wide = max(16, *(len(name) + 2 for name, _ in lines))
    return "\n".join(f"{name:<{wide}}{words}" for name, words in lines)


def _crossing_words(crossing: CertifiedCrossing) -> str:
    return f"{crossing.speed.digits()} m/s ({crossing.direction})"


def _scope(certificate: Certificate) -> str:
    over = [f"{name} {text}" for name, text in certificate.parameters.items() if text.startswith("from ")]
    who = f"for every {', '.join(over)}" if over else "for the parameters as written"
    return f"{who}, at every speed" if certificate.status == "certified" else f"{who}, but for what is undecided"


def _boxes(certificate: Certificate) -> str:
    return "" if certificate.boxes == 1 else f", {certificate.boxes} boxes"
