// Figure 2, as printed.
main:
NumEnvironments = 5
gosub Initialization
for E = 1 to NumEnvironments
gosub Environment
gosub Search
delay 2000
next
xyString 330,300,”ALL DONE”
end

// Figure 4, as printed.
Search:
//stepping on
while FoodCnt // search till food is gone
Senses = (rFeel()>>1)&7 // use only front 3 sensors
if Senses=0 // no obstacles, move forward looking for food
RepeatCount =0 // to prevent getting stuck
rForward Dist
if rLook(0)=Green // look straight ahead for food
// food seen, so eat it if it is close
if rBeacon(Green)<30 // eat food
x = rGPSx() // erase the food eaten
if x<200
call DrawCircle(x1,y1,white)
FoodCnt--
elseif x<550 and x>230
call DrawCircle(x2,y2,white)
FoodCnt--
else
call DrawCircle(x3,y3,white)
FoodCnt--
endif
endif
else // food is not seen so look around
if random(2) // turn to one side or the other
rTurn 2 +random(10)
else
rTurn -(2+random(10))
endif
endif
else // obstacles have been detected
// check to see if current situation is in memory
if Mem[Senses]
// some action has been saved
// do the saved action (either left or right
if Mem[Senses] = TurnLeft then rTurn -Deg
if Mem[Senses] = TurnRight then rTurn Deg
//See if this action is repeating do an about face
RepeatCount++
if RepeatCount=10 then rturn (150+random(60)) // boredom
else // no memory for this situtation
// try to find an action that will reduce the obstruction
// and if found, save it in memory
Cnt=0
call CountSensors(Senses,Cnt)// count the triggered sensors
OldSenses = Senses // remember the offending sensors
r=random(2)+1 // pick a random action (1 or 2)
// and perform that action
if r=TurnLeft then rTurn -45
if r=TurnRight then rTurn 45
Senses = (rFeel()>>1)&7 // new sensor reading
NewCnt=0
call CountSensors(Senses,NewCnt) // count triggered sensors
// if action r reduced blockage then save action
if NewCnt<Cnt then Mem[OldSenses]=r\gosub DisplayMem
endif
endif
wend
return

// What the article has in its downloads, for this robot: a pixel is 5 mm.
Initialization:
Dist = 2.4 // a step of 12 mm
Deg = 10
RepeatCount = 0
TurnLeft = 1
TurnRight = 2
dim Mem[8] // the robot's eight bytes, with what it has learned before
return

Environment:
FoodCnt = 3 // the world puts down the food and the obstacles
x1 = 100 \ y1 = 300 // a place for each third of the arena, where food may be
x2 = 390 \ y2 = 300
x3 = 675 \ y3 = 300
rLocate 400,300
return

DisplayMem:
for Cell = 1 to 7
xyString 10+90*Cell,580,Cell,": ",Mem[Cell]
next
return

sub CountSensors(Pattern,&Count)
for Bit = 0 to 2
if Pattern>>Bit & 1 then Count++
next
return

sub DrawCircle(X,Y,Color)
if Color = White then rEat // white on green: the food is gone
return
