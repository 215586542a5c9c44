"""Results into files: datasets, NetCDF, tables, UFF, the run record and the summary."""
