"""`bihdist paper`: the experiments of the paper drawn and bound into one page.

pictures (fields on surfaces), charts (curves), page (HTML) and reproduce (which experiments, on which meshes).
"""
