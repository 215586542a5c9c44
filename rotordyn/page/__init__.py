"""One self-contained HTML page: what it may show, and how that is written.

``blocks`` what a page is made of, plain data; ``curves`` charts of headline curves; ``declared`` of
any result; ``looks`` lines and marks; ``packed`` numbers in few bytes; ``html`` the page. Analyses
say what they contribute with blocks; nothing here knows one of them.
"""
