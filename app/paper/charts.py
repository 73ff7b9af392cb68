"""The charts of an experiment as SVG, drawn by matplotlib."""

import io

from bihdist_core.experiments import Chart

COLOURS = ("#1f4fbf", "#c2272d", "#4bb4d8", "#d9828c", "#5b6470", "#8a6d1c", "#2f7d4f")


def chart_svg(chart: Chart) -> str:
    """The chart as an <svg> element."""
    import matplotlib

    matplotlib.use("agg")
    from matplotlib.figure import Figure as Canvas

    with matplotlib.rc_context({"svg.fonttype": "none", "svg.hashsalt": chart.heading, "font.size": 10}):
        canvas = Canvas(figsize=(6.2, 3.9), layout="constrained")
        axes = canvas.add_subplot()
        for k, series in enumerate(chart.series):
            points = series.style == "points"
            axes.plot(
                series.x,
                series.y,
                color=COLOURS[k % len(COLOURS)],
                label=series.name,
                linestyle="" if points else ("-", "--", ":")[k // len(COLOURS) % 3],
                linewidth=1.6,
                marker="o" if points or len(series.x) <= 8 else "",
                markersize=4.5,
            )
        axes.set(title=chart.heading, xlabel=chart.x_label, ylabel=chart.y_label)
        if chart.log_x:
            axes.set_xscale("log")
        if chart.log_y:
            axes.set_yscale("log")
        axes.grid(color="#e3e6ea", linewidth=0.7)
        axes.spines[["top", "right"]].set_visible(False)
        if len(chart.series) > 1:
            axes.legend(frameon=False, fontsize=9)
        text = io.StringIO()
        canvas.savefig(text, format="svg", metadata={"Date": None})
    svg = text.getvalue()
    return svg[svg.index("<svg") :]
