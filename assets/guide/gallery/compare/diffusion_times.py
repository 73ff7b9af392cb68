"""
Diffusion distance at several times
===================================

The diffusion distance has a parameter, the time *t*, and no value suits a whole shape: small times see only the
neighbourhood of the source and are the same everywhere else; large times see only the coarsest structure. The
biharmonic distance has no such parameter.
"""

import bihdist

times = ["1/4", "1", "4", "16"]
distances = [*(f"diffusion(t={t})" for t in times), "biharmonic"]
picture = bihdist.figure(
    "hand",
    distances,
    source=6835,
    look={"clim": "fraction"},
    isolines=12,
    layout={"size": "1200x400"},
)
picture.save("diffusion_times.png")

# %%
# The same from the command line:
#
# .. code-block:: sh
#
#    bihdist figure hand --sources 6835 --clim fraction --isolines 12 \
#        --size 1200x400 -o diffusion_times.png \
#        \
#        --distance \
#        'diffusion(t=1/4),diffusion(t=1),diffusion(t=4),diffusion(t=16),biharmonic'
