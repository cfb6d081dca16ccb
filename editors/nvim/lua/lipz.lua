-- A client of `lipz lsp`: one server for each project.
local M = {}

-- Servers by the folders of their projects, for versions of Neovim that do not keep them.
local clients = {}

-- The folder of the project that a file belongs to: that of its lipz.toml, or its own.
local function root_of(file)
  local folder = vim.fn.fnamemodify(file, ":p:h")
  local settings = vim.fn.findfile("lipz.toml", vim.fn.escape(folder, " ,;*\\") .. ";")
  return settings ~= "" and vim.fn.fnamemodify(settings, ":p:h") or folder
end

-- Starts the server of a buffer's project if none runs, and attaches it to the buffer.
function M.attach(buffer)
  if buffer == 0 then
    buffer = vim.api.nvim_get_current_buf()
  end
  local command = vim.g.lipz_command or "lipz"
  if vim.fn.executable(command) == 0 then
    vim.notify_once("lipz.nvim: `" .. command .. "` is not a program; set g:lipz_command", vim.log.levels.WARN)
    return nil
  end
  local root = root_of(vim.api.nvim_buf_get_name(buffer))
  local config = {
    name = "lipz",
    cmd = { command, "lsp" },
    root_dir = root,
    workspace_folders = { { uri = vim.uri_from_fname(root), name = root } },
  }
  if vim.lsp.start then
    return vim.lsp.start(config, { bufnr = buffer })
  end
  config.on_exit = function()
    clients[root] = nil
  end
  clients[root] = clients[root] or vim.lsp.start_client(config)
  if clients[root] then
    vim.lsp.buf_attach_client(buffer, clients[root])
  end
  return clients[root]
end

return M
