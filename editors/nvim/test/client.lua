-- Neovim as a client of `lipz lsp`: `cargo xtask ci editors` runs it in a folder of its own, which it may write to.

local function write(name, text)
  local file = assert(io.open(name, "w"))
  file:write(text)
  file:close()
end

local function wait(what, condition)
  assert(vim.wait(60000, condition, 20), "waited in vain for " .. what)
end

-- The codes of the diagnostics that the buffer shows.
local function codes()
  local found = vim.tbl_map(function(diagnostic)
    return diagnostic.code or (diagnostic.user_data.lsp or {}).code
  end, vim.diagnostic.get(0))
  table.sort(found)
  return table.concat(found, " ")
end

-- The answer to a request about a place of the buffer: line and column from 0, in UTF-16.
local function ask(method, line, character, more)
  local params = vim.tbl_extend("force", {
    textDocument = vim.lsp.util.make_text_document_params(0),
    position = { line = line, character = character },
  }, more or {})
  local _, answer = next(assert(vim.lsp.buf_request_sync(0, method, params, 60000)))
  assert(not answer.error, vim.inspect(answer.error))
  return answer.result
end

local function run()
  write("lipz.toml", '[registry]\ncharacters = ["mara", "otto"]\n')
  write("otto.lipz", '{ "visemes": "MA", "viseme_type": "blair", "events": "otto sees mara" }\n')
  write("mara.lipz", '{ "visemes": "MAZ", "viseme_type": "blair",\n"fps": 10, "events": "mara feels " }\n')
  vim.cmd("edit mara.lipz")
  assert(vim.bo.filetype == "lipz", vim.bo.filetype)
  wait("the diagnostic of a code", function() return codes():find("LZ0401") end)
  assert(vim.diagnostic.get(0)[1].source == "lipz")

  -- Typing: behind a character of two UTF-16 units, and without saving.
  vim.api.nvim_buf_set_lines(0, 0, 1, false, { '{ "x𝄞": 1, "visemes": "MA E", "viseme_type": "blair",' })
  wait("the diagnostic of a blank", function() return codes():find("LZ0402") end)
  local hover = ask("textDocument/hover", 0, 27)
  assert(hover.contents.value:find("frame 2, 0.200 s", 1, true), vim.inspect(hover))

  local offers = ask("textDocument/completion", 1, 33)
  local labels = vim.tbl_map(function(item) return item.label end, offers.items or offers)
  assert(vim.tbl_contains(labels, "happy"), vim.inspect(labels))

  -- The quick action of the blank, made as Neovim makes it.
  local range = { start = { line = 0, character = 26 }, ["end"] = { line = 0, character = 26 } }
  local actions = ask("textDocument/codeAction", 0, 0, { range = range, context = { diagnostics = {}, only = { "quickfix" } } })
  vim.lsp.util.apply_workspace_edit(actions[1].edit, "utf-16")
  assert(vim.fn.getline(1):find('"MAE"', 1, true), vim.fn.getline(1))

  vim.api.nvim_buf_set_lines(0, 1, 2, false, { '"fps": 10, "events": "mara sees otto" }' })
  local edit = ask("textDocument/rename", 1, 24, { newName = "nell" })
  vim.lsp.util.apply_workspace_edit(edit, "utf-16")
  assert(vim.fn.getline(2):find("nell sees otto", 1, true), vim.fn.getline(2))
  vim.cmd("silent wall")
  assert(table.concat(vim.fn.readfile("otto.lipz")):find("otto sees nell", 1, true))
  assert(table.concat(vim.fn.readfile("lipz.toml")):find('"nell", "otto"', 1, true))

  local edits = ask("textDocument/formatting", 0, 0, { options = { tabSize = 2, insertSpaces = true } })
  vim.lsp.util.apply_text_edits(edits, 0, "utf-16")
  assert(vim.fn.getline(1) == "{" and vim.fn.getline(2):find('^  "visemes" : '), vim.fn.getline(2))
  wait("the end of all diagnostics but one", function() return codes() == "LZ0203" end)
end

local ok, why = xpcall(run, debug.traceback)
if not ok then
  io.stderr:write(tostring(why) .. "\n")
  vim.cmd("cquit 1")
end
io.stdout:write("Neovim has diagnostics, hover, completion, actions, rename and formatting\n")
vim.cmd("qall!")
