# Settings and commands for a robot in gdb.
set pagination off
set confirm off
set print pretty on
set print inferior-events off
set debuginfod enabled off

define cells
  output/u robot->brain.memory.cell
  echo \n
end
document cells
Print the eight bytes of the robot's memory.
end
