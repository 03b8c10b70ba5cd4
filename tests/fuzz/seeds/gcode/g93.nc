%
N10 G91 ; incremental
(dwell: gcode=g93-seconds)
G90 G0 Z1
G0 X0 Y0
G1 Z0 F60
G93
G91
G1 X1 Y-2 F0.5
M30
%
