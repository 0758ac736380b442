# The robot of a log, as octet-debug. tools/octet debug sets the folder in which `feed` is.
set startup-with-shell off
break robot.c:step
commands
  silent
  printf "tick %u, %.2f s, %lu of %lu drives differ from the log's\n", tick, time_ms / 1000.0, differing, compared
  frame
end
break stop_here
set $stop = $bpnum
commands
  silent
end

define goto
  disable
  enable $stop
  set args feed $arg0
  run
  enable
  continue
end
document goto
goto N: start again, and stop where tick N enters the robot's step. All breakpoints are enabled there.
end
