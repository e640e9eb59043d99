#include "apps/console/terminal_size.h"

#include <sys/ioctl.h>

namespace kaustik::app {

TerminalSize terminal_size(int file) {
  TerminalSize size;
  winsize told{};
  if (ioctl(file, TIOCGWINSZ, &told) != 0) return size;
  if (told.ws_col > 0) size.columns = told.ws_col;
  if (told.ws_row > 0) size.rows = told.ws_row;
  size.width = told.ws_xpixel, size.height = told.ws_ypixel;
  return size;
}

}  // namespace kaustik::app
