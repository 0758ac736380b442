# gdb-multiarch -x hal/stm32/stm32f103/debug.gdb build/blue_pill/octet-blue_pill-bxcan.elf
# Stops at reset. The watchdog goes on while the core stands, so it is frozen (DBGMCU_CR, RM0008 31.16.3).
target extended-remote | openocd -f interface/stlink.cfg -f target/stm32f1x.cfg -c "gdb_port pipe; log_output /dev/null"
monitor reset halt
set {unsigned int}0xE0042004 = {unsigned int}0xE0042004 | 0x100
