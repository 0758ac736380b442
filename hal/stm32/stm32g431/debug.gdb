# gdb-multiarch -x hal/stm32/stm32g431/debug.gdb build/nucleo_g431rb/octet-nucleo_g431rb-fdcan.elf
# Stops at reset. The watchdog goes on while the core stands, so it is frozen (DBGMCU_APB1FZR1, RM0440 47.6.3).
target extended-remote | openocd -f interface/stlink.cfg -f target/stm32g4x.cfg -c "gdb_port pipe; log_output /dev/null"
monitor reset halt
set {unsigned int}0xE0042008 = {unsigned int}0xE0042008 | 0x1000
