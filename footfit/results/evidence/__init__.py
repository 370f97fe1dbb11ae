"""What verdicts rest on: profiles with sources, what is worn, growth, and what wearers say."""
