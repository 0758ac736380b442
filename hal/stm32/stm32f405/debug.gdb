# gdb-multiarch -x hal/stm32/stm32f405/debug.gdb build/feather_stm32f405/octet-feather_stm32f405-bxcan.elf
# Stops at reset. The watchdog goes on while the core stands, so it is frozen (DBGMCU_APB1_FZ, RM0090 38.16.4).
target extended-remote | openocd -f interface/stlink.cfg -f target/stm32f4x.cfg -c "gdb_port pipe; log_output /dev/null"
monitor reset halt
set {unsigned int}0xE0042008 = {unsigned int}0xE0042008 | 0x1000
