"""The widget in a browser, with a model that stands for that of a notebook."""

import json
from base64 import b64encode

from app.web.widget import widget
from tests.shapes import bumpy

HOST = """<!doctype html><meta charset="utf-8"><style>STYLE</style><div id="one"></div><div id="other"></div>
<script type="module">ESM
const traits = TRAITS;
const bytes = (text) => new DataView(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);
for (const name in traits.contents) traits.contents[name] = bytes(traits.contents[name]);
class Model {
  constructor(values) { Object.assign(this, { values, heard: {}, sent: [], saved: 0 }); }
  get(name) { return this.values[name]; }
  set(name, value) { this.values[name] = value, this.heard["change:" + name]?.forEach((act) => act()); }
  save_changes() { this.saved++; }
  send(content) { this.sent.push(content); }
  on(event, act) { (this.heard[event] ??= new Set()).add(act); }
  off(event, act) { this.heard[event].delete(act); }
}
window.model = new Model(traits);
window.ends = [];
for (const id of ["one", "other"]) window.ends.push(await widget.render({ model, el: document.getElementById(id) }));
</script>"""

ON_SURFACE = """(() => {
  const { sight, stage } = document.querySelector("#one .bihdist").viewer, box = stage.views[0].getBoundingClientRect();
  for (const x of [0.5, 0.4, 0.6, 0.3, 0.7]) for (const y of [0.5, 0.4, 0.6, 0.3, 0.7])
    if (sight.hit(0, x * box.width, y * box.height)) return [box.x + x * box.width, box.y + y * box.height];
})()"""


WHOLE = """[...document.querySelectorAll("#one .panel h2, #one .view, #one .scale, #one .stage")].every((part) => {
  const bounds = document.querySelector("#one .stage").getBoundingClientRect(), box = part.getBoundingClientRect();
  return box.height > 20 && box.top >= bounds.top && box.bottom <= bounds.bottom && box.right <= bounds.right;
})"""


def show(browser, made, folder):
    """Open a page that shows a widget in two places."""
    contents = {name: b64encode(content).decode() for name, content in made.contents.items()}
    traits = {"contents": contents, "scene": made.scene, "source": made.source, "pins": made.pins}
    esm = made._esm.replace("export default { render };", "const widget = { render };")
    host = folder / "host.html"
    filled = HOST.replace("STYLE", made._css).replace("ESM", esm).replace("TRAITS", json.dumps(traits))
    host.write_text(filled, encoding="utf-8")
    browser.open(host)
    browser.until("window.ends.length === 2", 100)


def test_the_first_view_is_whole_with_pins_and_the_wheel_scrolls_the_notebook(browser, tmp_path):
    browser.size(968, 700)
    show(browser, widget("hand", ["biharmonic", "geodesic"], marks={"pins": [12, 90]}), tmp_path)
    browser.until("document.querySelector('#one .bihdist').viewer.answers.every(Boolean)")
    assert browser.evaluate(WHOLE)
    assert browser.evaluate("document.querySelector('#one .tools').offsetHeight") < 50
    # Where its content decides, as in a row of widgets, there is room for it, too.
    browser.evaluate("void (document.getElementById('other').style.display = 'inline-block')")
    assert browser.evaluate("document.querySelector('#other .bihdist').offsetWidth") >= 400
    browser.wheel(300, 200, 100)
    browser.until("scrollY > 0")
    assert browser.errors == []


def test_source_and_pins_go_both_ways_between_places_and_model(browser, tmp_path):
    show(browser, widget(bumpy(300), ["biharmonic"], source=12), tmp_path)
    shown = "[...document.querySelectorAll('.bihdist input')].map(each => each.value)"
    browser.until(f"{shown}.filter(value => value === '12').length === 2")
    # Python's side sets the source: both places show it, and no click is told.
    browser.evaluate("model.set('source', 99)")
    browser.until(f"{shown}.filter(value => value === '99').length === 2")
    assert browser.evaluate("model.sent") == []
    # A click in one place goes to the model, and from there to the other.
    browser.until("document.querySelector('#one .bihdist').viewer.answers.every(Boolean)")
    browser.click(*browser.evaluate(ON_SURFACE))
    browser.until("model.sent.length === 1")
    picked = browser.evaluate("model.sent[0].picked")
    assert picked not in (12, 99)
    assert browser.evaluate("[model.get('source'), model.saved > 0]") == [picked, True]
    browser.until(f"{shown}.filter(value => value === '{picked}').length === 2")
    # Places that are gone leave nothing behind.
    browser.evaluate("window.ends.forEach(end => end())")
    assert browser.evaluate("Object.values(model.heard).every(each => each.size === 0)")
    assert browser.evaluate("document.querySelectorAll('canvas').length") == 0
    assert browser.errors == []
