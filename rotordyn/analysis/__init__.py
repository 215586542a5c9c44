"""The questions: what is asked (specs), what is answered (results), and how, one file each."""
