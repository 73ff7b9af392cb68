"""BibTeX entries for the paper and for this program."""

from .version import version

PAPER = "10.1145/1805964.1805971"
"""The DOI of the paper."""


def bibtex() -> str:
    """Return the entries of the paper and of this version of the program, which `CITATION.cff` has, too."""
    return f"""@article{{lipman2010biharmonic,
  author  = {{Lipman, Yaron and Rustamov, Raif M. and Funkhouser, Thomas A.}},
  title   = {{Biharmonic Distance}},
  journal = {{ACM Transactions on Graphics}},
  volume  = {{29}},
  number  = {{3}},
  pages   = {{27:1--27:11}},
  year    = {{2010}},
  doi     = {{{PAPER}}}
}}

@software{{bihdist,
  author  = {{{{The bihdist authors}}}},
  title   = {{{{bihdist}}: exact biharmonic distances on triangle meshes}},
  version = {{{version()}}},
  year    = {{2026}}
}}"""
