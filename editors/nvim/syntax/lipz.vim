" Lipz files are JSON.
runtime! syntax/json.vim
