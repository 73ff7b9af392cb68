"""Pages before, over or beside the panels: the start page, messages, preferences, help."""
