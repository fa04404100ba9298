// Quantities as the controls show them and as scenes and seeder files hold them.

const radiansOfADegree = Math.PI / 180;

/** The metres that the program reads in "`mm` mm": the same number to the last bit, which a test shows on the program itself. */
export function metresOf(mm) {
  return mm / 1000;
}

/** The radians that the program reads in "`degree` degree". */
export function radiansOf(degree) {
  return degree * radiansOfADegree;
}

/** To one decimal, as the controls have it. */
export function tenths(value) {
  return Math.round(value * 10) / 10;
}

/** The nearest tenth of a millimetre. */
export function mmOf(metres) {
  return tenths(metres * 1000);
}

/** The nearest tenth of a degree. */
export function degreesOf(radians) {
  return tenths(radians / radiansOfADegree);
}

/** A length as a seeder file has it: in millimetres where a tenth of one is exact, else in metres with all digits. */
export function lengthText(metres) {
  const mm = mmOf(metres);
  return metresOf(mm) === metres ? `${mm} mm` : `${metres} m`;
}

/** An angle as a seeder file has it. */
export function angleText(radians) {
  const degree = degreesOf(radians);
  return radiansOf(degree) === radians ? `${degree} degree` : `${radians} rad`;
}
