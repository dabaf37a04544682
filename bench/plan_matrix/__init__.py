"""What plan_matrix has measured: read, judged, drawn."""
