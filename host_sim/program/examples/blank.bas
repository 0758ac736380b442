// A blank program: the robot stands still. Write what it is to do.
while true
  delay 100
wend
