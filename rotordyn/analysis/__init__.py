"""The questions: each file holds a Spec (what is asked), a frozen Result, and how it is answered."""
