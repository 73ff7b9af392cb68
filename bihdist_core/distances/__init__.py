"""The distances, one each, and what they have in common."""
