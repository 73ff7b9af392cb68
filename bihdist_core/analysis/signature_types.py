"""The table of signatures of vertices; as that of distances, it imports neither numpy nor what computes them."""

from ..distances.distance_types import PAPER_TIMES, DistanceType, Parameter, Spec
from ..errors import ParameterError

SIGNATURES = {
    each.word: each
    for each in (
        DistanceType(
            "centrality",
            "Centrality",
            "the mean squared biharmonic distance to all points: least in the middle, largest at tips",
            "bihdist_core.analysis.signatures:centrality",
            squares="mean of d² over the surface",
            scaling="2",
            short="Central.",
            is_complete=True,
        ),
        DistanceType(
            "bks",
            "Biharmonic kernel signature",
            "large at tips and on thin parts, on all scales at once",
            "bihdist_core.analysis.signatures:biharmonic_kernel_signature",
            squares="Σ φₖ² / λₖ², all k",
            scaling="2",
            short="BKS",
            is_complete=True,
        ),
        DistanceType(
            "hks",
            "Heat kernel signature",
            "the heat that stays: large at tips and where the surface is curved like a dome, on the scale of t",
            "bihdist_core.analysis.signatures:heat_kernel_signature",
            (
                Parameter(
                    "t",
                    1 / 4,
                    "diffusion time",
                    shown=(1 / 100, PAPER_TIMES[-1]),
                    logarithmic=True,
                    marks=(1 / 100, *PAPER_TIMES),
                ),
            ),
            squares="Σ exp(−t λₖ/λ₁) φₖ², with λ₀ = 0",
            scaling="−2",
            short="HKS",
            is_complete=True,
        ),
        DistanceType(
            "wks",
            "Wave kernel signature",
            "where waves of one energy are: large energies tell fine details apart",
            "bihdist_core.analysis.signatures:wave_kernel_signature",
            (
                Parameter(
                    "energy",
                    10.0,
                    "the energy of the waves, in units of the first eigenvalue",
                    shown=(1.0, 1000.0),
                    logarithmic=True,
                    marks=(1.0, 10.0, 100.0, 1000.0),
                ),
                Parameter(
                    "sigma",
                    0.4,
                    "by how much the logarithms of energies vary",
                    above=0.05,
                    at_most=1.0,
                    shown=(0.1, 1.0),
                    logarithmic=True,
                ),
            ),
            squares="Σ wₖ φₖ² / Σ wₖ, wₖ = exp(−ln²(λₖ / energy λ₁) / 2σ²)",
            scaling="−2",
            short="WKS",
            is_complete=True,
        ),
    )
}
"""The rows by their words; `make` is called with a Laplacian, the parameters and ``progress``, and returns a
`Signature`."""


class SignatureSpec(Spec):
    """A signature's word with its parameters: hks(t=1/4), bks."""

    @classmethod
    def type_of(cls, word: str) -> DistanceType:
        """Return the row of a word; ParameterError, with all words, if there is none."""
        if word not in SIGNATURES:
            raise ParameterError(f"There is no signature {word!r}; choose one of {', '.join(SIGNATURES)}.")
        return SIGNATURES[word]


def is_signature(text: str) -> bool:
    """Return whether a text such as hks(t=1/4) begins with the word of a signature."""
    return text.partition("(")[0].strip() in SIGNATURES
