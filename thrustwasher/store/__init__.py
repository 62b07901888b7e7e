"""What the package ships and reads back: cards of verified errors, maps."""
