(* The machine that the analyser assumes: a 32-bit ARM with its EABI. Unlike x86, its char is unsigned and 8 bytes are
   aligned to 8. *)
let machine =
  { Machdeps.gcc_x86_32 with
    Cil_types.char_is_unsigned = true; wchar_t = "unsigned int"; alignof_longlong = 8; alignof_double = 8;
    sizeof_longdouble = 8; alignof_longdouble = 8; version = "ARM EABI" }

let () = File.new_machdep "arm_eabi" machine
