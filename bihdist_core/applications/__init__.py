"""What the paper does with distances (section 5): interpolation, correspondence, and what they withstand."""
