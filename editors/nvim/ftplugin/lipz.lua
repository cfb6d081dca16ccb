-- Serves the Lipz file of this buffer.
require("lipz").attach(0)
