"""The line over a panel in the hands of tests: its menus, and what is seen of it."""


def entries(menu):
    """The entries of a menu as it opens, by their words."""
    menu.aboutToShow.emit()
    return {action.text(): action for action in menu.actions() if not action.isSeparator()}


def choose(head, *path):
    """Go through the name's menu."""
    menu = head.name.menu()
    for word in path[:-1]:
        menu = entries(menu)[word].menu()
    entries(menu)[path[-1]].trigger()


def shown(head):
    return [control for control in head.controls if control.isVisibleTo(head)]
