// The article's simple coding solution, with one rule only: what is at the front right makes it turn left.
while true
  if rFeel()=2 then rTurn -10
  rForward 2
  if rBeacon(Green)>0 and rBeacon(Green)<30 then rEat
wend
