(dwell 0.3.0)
(input: map ...mirror.csv sha256=2c26b46b68ffc68ff99b453c)
(option: map_steps = average:a.csv,)
(option+: map_steps = b.csv)
(record: fcde2b2edba56bf408601fb721fe9b5c338d10ee429ea04fae5511b68fbf8fb9)
(dwell: gcode=g93-per-minute, g4=seconds)
(dwell: tool at work when Z=0, lifted when Z>0)
(dwell: zero=1.500000/-2.000000 rotate=37.5 swap=yes)
(units: X Y Z inch, F 1/[minutes of the move], P seconds)
N10 G20
N20 G90
N30 G17
N40 G93
N50 G64 P0.00196850
N60 G0 Z0.39370079
N70 G0 X0.03937008 Y0.07874016
N80 G1 Z0 F300
N90 G1 X0.11811024 Y0.15748031 F15
N100 G4 P0.5
N110 G0 Z0.39370079
N120 G94
N130 M2
