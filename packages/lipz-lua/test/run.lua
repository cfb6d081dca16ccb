--- Runs all tests of this package: `lua test/run.lua`, in `packages/lipz-lua`.

package.path = "./?.lua;./?/init.lua;" .. package.path

local failures = 0

local function report(name, counts, problem)
  print(("%s: %s"):format(name, problem and "FAILED\n" .. problem or counts))
  if problem then failures = failures + 1 end
end

local run, skipped, problem = require("test.cases")()
report("cases", ("%d commands, %d skipped"):format(run, skipped), problem)
local count
count, problem = require("test.dumps")()
report("dumps", ("%d banks"):format(count), problem)
run, skipped, problem = require("test.damaged")()
report("damaged banks", ("%d commands, %d skipped"):format(run, skipped), problem)
report("segments outside clips", ("%d queries"):format(require("test.outside")()))
report("damaged text banks", ("%d files"):format(require("test.texts")()))
count, problem = require("test.readme")("packages/lipz-lua/README.md")
report("readme", ("%d lines"):format(count), problem)
count, problem = require("test.readme")("docs/guides/lua.md")
report("guide", ("%d lines"):format(count), problem)
report("names of shapes", ("%d models"):format(require("test.shapes")()))
count, problem = require("test.scene")()
report("sample", ("%d rendered frames"):format(count), problem)
os.exit(failures == 0 and 0 or 1)
