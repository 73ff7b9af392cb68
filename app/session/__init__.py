"""What is open and asked: questions, answers, and the lanes that work on them.  Neither Qt nor VTK."""
